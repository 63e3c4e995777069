// A set of points on the unit square sorted into the cells of a grid, with the number of points before each cell: the
// points of a stretch of cells are counted by one subtraction.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "core/geometry.h"

namespace moire {

class PointGrid {
 public:
  PointGrid() = default;  // no cells

  // x and y in [0, 1), at most 2^31 - 1 of them. The grid has the power of two to a side that leaves 1/2 to 2 points a
  // cell, at most 2^12: with that many, four million counts are small beside the points.
  PointGrid(std::span<const double> x, std::span<const double> y) {
    const auto n = x.size();
    while (digits_ < 12 && (n >> (2 * digits_ + 1)) > 0) ++digits_;
    const auto cells = static_cast<std::size_t>(side()) * static_cast<std::size_t>(side());
    first_.resize(cells + 1);
    const auto cell = [&](std::size_t i) {
      // Exact: a product with a power of two.
      return static_cast<std::size_t>(y[i] * side()) << digits_ | static_cast<std::size_t>(x[i] * side());
    };
    for (std::size_t i = 0; i < n; ++i) ++first_[cell(i)];
    std::int32_t before = 0;
    for (std::int32_t& v : first_) {
      before += v;
      v = before;
    }
    points_.resize(n);
    for (std::size_t i = n; i-- > 0;) points_[static_cast<std::size_t>(--first_[cell(i)])] = {x[i], y[i]};
  }

  bool empty() const noexcept { return points_.empty(); }
  // Cells to a side, 2^digits().
  int side() const noexcept { return 1 << digits_; }
  int digits() const noexcept { return digits_; }

  // Points of the cells begin <= i < end of a row, begin <= end <= side().
  std::int32_t count(int row, int begin, int end) const noexcept {
    const std::int32_t* first = first_.data() + (static_cast<std::ptrdiff_t>(row) << digits_);
    return first[end] - first[begin];
  }
  std::span<const Vec2> points(int row, int begin, int end) const noexcept {
    const std::int32_t* first = first_.data() + (static_cast<std::ptrdiff_t>(row) << digits_);
    return {points_.data() + first[begin], points_.data() + first[end]};
  }

 private:
  int digits_ = 0;
  std::vector<std::int32_t> first_;  // of each cell, row-major, and the end
  std::vector<Vec2> points_;         // by cell
};

}  // namespace moire
