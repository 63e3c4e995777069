// One set of points as the discrepancies see it.
#pragma once

#include <cstddef>
#include <span>

namespace moire {

// Points of the unit square or cube, all coordinates in [0, 1); in any order, any of them may coincide. At least one.
struct PointView {
  std::span<const double> x, y;
  std::span<const double> t = {};  // as long as x and y; empty: points of the square

  std::size_t size() const noexcept { return x.size(); }
  int dims() const noexcept { return t.empty() ? 2 : 3; }
};

}  // namespace moire
