// One set of points over a whole image, sorted by pixel.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/geometry.h"
#include "patterns/pattern.h"

namespace moire {

class AreaPoints {
 public:
  // About `spp` points per pixel over the pixels -apron .. grid + apron - 1; with a time each on demand,
  // if the pattern has one. Throws Error as PatternChoice::area_count() does.
  AreaPoints(const PatternChoice& choice, Grid grid, int apron, std::int64_t spp, Draw draw, bool with_time = false);

  std::int64_t count() const noexcept { return static_cast<std::int64_t>(x_.size()); }
  // Points per pixel, on the average over the area.
  double density() const noexcept;
  bool has_time() const noexcept { return !t_.empty(); }
  // Whether it was made for images of this size under filters of this apron.
  bool fits(Grid grid, int apron) const noexcept { return grid_ == grid && apron_ == apron; }

  // The points of pixels x0 <= x < x1 of row y: consecutive, pixel by pixel, in the order in which the pattern made
  // them; pixel x0 + i has those from first[i] to first[i + 1]. x and y in [0, 1) from their pixel's corner.
  struct RowPoints {
    std::span<const std::size_t> first;  // x1 - x0 + 1 entries, indices into all points
    std::span<const double> x, y;        // all points
    std::span<const double> t;           // all points, or empty
  };
  RowPoints points(int x0, int x1, int y) const noexcept;

 private:
  Grid grid_;
  int apron_;
  std::vector<double> x_, y_, t_;   // t_ empty: no time
  std::vector<std::size_t> first_;  // by pixel of the area, row-major, and the end
};

}  // namespace moire
