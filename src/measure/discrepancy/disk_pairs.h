// What pairs of points contribute to the L2 discrepancies of disks, several pairs at a time: the inner loop, which
// wants wide vectors.
#pragma once

#include <span>

#include "measure/discrepancy/disk_overlap.h"
#include "measure/discrepancy/pair_sum.h"

namespace moire {

// Writes for kPairLanes points (x, y) of the columns the sum of the overlaps of a disk around the point of the row and
// of those around the other pointits images; disks of diameter 2R, and scale = 1 / (2R)^2. All points in [0, 1)^2.
// of the overlaps of a disk around one point and of those around all images of the other one; disks of diameter 2R, and
// scale = 1 / (2R)^2. |dx| and |dy| are below 1.
using DiskTerms = void (*)(const DiskOverlap& overlap, double scale, double row_x, double row_y, const double* x,
                           const double* y, double* value);

// The loops that this machine can run, the widest vectors last; all give the same bits. For 2R <= 1, or with one image,
// the nearest one along both axes, for 2R <= 1/2.
std::span<const DiskTerms> disk_terms();
std::span<const DiskTerms> disk_terms_of_one_image();

}  // namespace moire
