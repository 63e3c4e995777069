// One set of points over a whole image, sorted by pixel: a counting sort, which keeps the order within a pixel.
#include "patterns/area_points.h"

#include <cmath>

namespace moire {

AreaPoints::AreaPoints(const PatternChoice& choice, Grid grid, int apron, std::int64_t spp, Draw draw, bool with_time)
    : grid_(grid), apron_(apron) {
  const Grid area{grid.width + 2 * apron, grid.height + 2 * apron};
  const auto count = static_cast<std::size_t>(choice.area_count(area, spp));
  std::vector<double> x(count), y(count), t(with_time ? count : 0);
  choice.info().fill_area(choice.args(), area, draw, {x, y, t});

  const auto width = static_cast<std::size_t>(area.width);
  const auto pixel_of = [&](std::size_t i) {
    return static_cast<std::size_t>(y[i]) * width + static_cast<std::size_t>(x[i]);
  };
  first_.assign(width * static_cast<std::size_t>(area.height) + 1, 0);
  for (std::size_t i = 0; i < count; ++i) ++first_[pixel_of(i) + 1];
  for (std::size_t p = 1; p < first_.size(); ++p) first_[p] += first_[p - 1];
  std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
  x_.resize(count);
  y_.resize(count);
  t_.resize(t.size());
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t to = next[pixel_of(i)]++;
    x_[to] = x[i] - std::floor(x[i]);  // exact
    y_[to] = y[i] - std::floor(y[i]);
    if (!t.empty()) t_[to] = t[i];
  }
}

double AreaPoints::density() const noexcept {
  return static_cast<double>(count()) / static_cast<double>(first_.size() - 1);
}

AreaPoints::RowPoints AreaPoints::points(int x0, int x1, int y) const noexcept {
  const auto width = static_cast<std::size_t>(grid_.width + 2 * apron_);
  const std::size_t begin = static_cast<std::size_t>(y + apron_) * width + static_cast<std::size_t>(x0 + apron_);
  return {{first_.data() + begin, static_cast<std::size_t>(x1 - x0) + 1}, x_, y_, t_};
}

}  // namespace moire
