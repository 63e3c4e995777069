// From the unit square to the area of an image.
#pragma once

#include <cmath>
#include <cstdint>
#include <span>

#include "core/args.h"
#include "core/geometry.h"
#include "patterns/pattern.h"

namespace moire {

// Numbers of [0, 1) to [0, side): a product that rounds to `side` becomes the number before it.
inline void scale_to(int side, std::span<double> coordinate) noexcept {
  const double last = std::nextafter(static_cast<double>(side), 0.0);
  for (double& v : coordinate) v = std::fmin(v * side, last);
}

// The points of a set on the unit square, stretched over the area.
inline void stretch(Grid area, Points points) noexcept {
  scale_to(area.width, points.x);
  scale_to(area.height, points.y);
}

// area_count of patterns that take any number of points.
inline std::int64_t any_area_count(const Args&, Grid, std::int64_t n) { return n; }

}  // namespace moire
