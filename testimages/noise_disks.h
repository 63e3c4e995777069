// The disks of a noise field: small, disjoint, at random places, so many that an image of them has nearly the same
// power at all frequencies up to the pixel's.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "core/geometry.h"
#include "testimages/circle.h"

namespace moire {

// Centres are anywhere in the image and up to this far beyond its border, in pixels. The largest windows of the
// catalogue's filters (radius 32, of lanczos:a=16,blur=2) stay 32 pixels away from where the field ends, and so are
// four diameters of the largest disks away from where centres have neighbours on one side only.
inline constexpr int kFieldMargin = 64;

// What disks may be asked for. Radii in pixels.
inline constexpr double kMinFieldRadius = 1e-6, kMaxFieldRadius = 8;
inline constexpr std::int64_t kMaxFieldDisks = std::int64_t{1} << 23;  // half a GiB
// Largest part of image and margin that disks of the mean area may cover. Random sequential placing never ends above
// 0.547 (for disks of one size: E. L. Hinrichsen, J. Feder and T. Jossang, "Random packing of disks in two dimensions",
// Physical Review A 41, 1990); here still one candidate in 15 finds room.
inline constexpr double kMaxFieldCoverage = 0.35;

// What defines a field beside the size of the image.
struct NoiseDisks {
  std::int64_t count = 0;  // in the image and its margin
  double min_radius = 0, max_radius = 0;
  std::uint64_t seed = 1;
};

// Square pixels of the image and its margin.
double field_area(Grid grid);

// Largest count of such disks that make() accepts.
std::int64_t most_noise_disks(double min_radius, double max_radius, Grid grid);

// The disks, largest first. The law, with unit(...) the uniform numbers of core/hash.h under the key of (seed, trial 0,
// pixel (0, 0)) and Axis::field: radius k is min + (max - min) u for index k and part 0; radii are sorted, largest
// first; the centre of disk k of that order is the first of its candidates, those of index k and parts 1, 2, ..., that
// leaves the disk free of those before it; a candidate is (u (width + 2 margin) - margin, v (height + 2 margin) -
// margin). All in double arithmetic as written, so that the same disks come out on every machine. Neighbours stay apart
// by 2^-40 of their distance at least.
//
// Largest first: a large disk would find no room among many small ones.
//
// Throws Error at `place` for a count above most_noise_disks() or kMaxFieldDisks. Time about 1 us a disk at low
// density.
std::vector<GivenCircle> make_noise_disks(const NoiseDisks& field, Grid grid, std::string_view place);

}  // namespace moire
