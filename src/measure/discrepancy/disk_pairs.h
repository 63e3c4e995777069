// What pairs of points contribute to the L2 discrepancies of disks, several pairs at a time: the inner loop, which
// wants wide vectors.
#pragma once

#include <span>

#include "measure/discrepancy/disk_overlap.h"
#include "measure/discrepancy/pair_sum.h"

namespace moire {

// Adds to `sum`, for each of the points (x, y) of the columns in turn, the sum of the overlaps of a disk around the
// point of the row and of those around all images of the other point; disks of diameter 2R, and scale = 1 / (2R)^2. The
// number of columns is a multiple of kPairLanes and at most kPairBlock. All points in [0, 1)^2.
using DiskTerms = void (*)(const DiskOverlap& overlap, double scale, double row_x, double row_y,
                           std::span<const double> x, std::span<const double> y, PairRow& sum);

// The loops that this machine can run, the widest vectors last; all give the same bits. For 2R <= 1, or with one image,
// the nearest one along both axes, for 2R <= 1/2.
std::span<const DiskTerms> disk_terms();
std::span<const DiskTerms> disk_terms_of_one_image();

}  // namespace moire
