// A set of points on the unit square sorted into the cells of a grid, with the number of points before each cell: the
// points of a stretch of cells are counted by one subtraction.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

#include "core/geometry.h"

namespace moire {

class PointGrid {
 public:
  PointGrid() = default;  // no cells

  // Room for n points, at most 2^31 - 1; untouched before sort(). The grid has the power of two to a side that leaves
  // 1/2 to 2 points a cell, at most 2^12: with that many, four million counts are small beside the points.
  explicit PointGrid(std::size_t n) : n_(n) {
    while (digits_ < 12 && (n >> (2 * digits_ + 1)) > 0) ++digits_;
    first_ = std::make_unique_for_overwrite<std::int32_t[]>(cells() + 1);
    points_ = std::make_unique_for_overwrite<Vec2[]>(n);
  }
  PointGrid(std::span<const double> x, std::span<const double> y) : PointGrid(x.size()) { sort(x, y); }

  // Takes the points, x and y in [0, 1), as many as there is room for.
  void sort(std::span<const double> x, std::span<const double> y) noexcept {
    const auto cell = [&](std::size_t i) {
      // Exact: a product with a power of two.
      return static_cast<std::size_t>(y[i] * side()) << digits_ | static_cast<std::size_t>(x[i] * side());
    };
    const std::span<std::int32_t> first(first_.get(), cells() + 1);
    std::fill(first.begin(), first.end(), 0);
    for (std::size_t i = 0; i < n_; ++i) ++first[cell(i)];
    std::int32_t before = 0;
    for (std::int32_t& v : first) {
      before += v;
      v = before;
    }
    for (std::size_t i = n_; i-- > 0;) points_[static_cast<std::size_t>(--first[cell(i)])] = {x[i], y[i]};
  }

  bool empty() const noexcept { return n_ == 0; }
  // Cells to a side, 2^digits().
  int side() const noexcept { return 1 << digits_; }
  int digits() const noexcept { return digits_; }

  // Points of the cells begin <= i < end of a row, begin <= end <= side().
  std::int32_t count(int row, int begin, int end) const noexcept {
    const std::int32_t* first = first_.get() + (static_cast<std::ptrdiff_t>(row) << digits_);
    return first[end] - first[begin];
  }
  std::span<const Vec2> points(int row, int begin, int end) const noexcept {
    const std::int32_t* first = first_.get() + (static_cast<std::ptrdiff_t>(row) << digits_);
    return {points_.get() + first[begin], points_.get() + first[end]};
  }

 private:
  std::size_t cells() const noexcept { return std::size_t{1} << (2 * digits_); }

  std::size_t n_ = 0;
  int digits_ = 0;
  std::unique_ptr<std::int32_t[]> first_;  // of each cell, row-major, and the end
  std::unique_ptr<Vec2[]> points_;         // by cell
};

}  // namespace moire
