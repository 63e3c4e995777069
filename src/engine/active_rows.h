// Which pixels are unknown: per image row, sorted runs of pixels whose windows hold nothing of the scene, only scene,
// or meet its boundary. Found by halving the image wherever the boundary may pass, so that time and memory grow with
// the boundary and the number of rows, not with the area.
//
// The window of a pixel is the closed square of half width R around its centre, R the filter's radius. A pixel is
// active when its window, grown by kGrowth, may meet the boundary. Windows are active, cells are sampled: a wide
// filter's active pixel needs the samples of every cell that its window touches.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/geometry.h"
#include "testimages/testimage.h"

namespace moire {

// Growth of windows before they are classified, in pixels: well above any rounding of a window's corners.
inline constexpr double kGrowth = 0x1p-20;

// Pixels x0 <= x < x1 of one row. cover == partial: active.
struct Run {
  std::int32_t x0 = 0, x1 = 0;
  Cover cover = Cover::none;
};

class ActiveRows {
 public:
  ActiveRows(Grid grid, std::vector<Run> runs, std::vector<std::size_t> row_begin);

  Grid grid() const noexcept { return grid_; }
  // The runs of row y, left to right: they cover [0, width) without gaps.
  std::span<const Run> row(int y) const noexcept;
  std::int64_t active_pixels() const noexcept { return first_active_.back(); }
  // Active pixels before row y, in row-major order: the index of the row's first one in per-active-pixel arrays.
  std::int64_t first_active(int y) const noexcept { return first_active_[static_cast<std::size_t>(y)]; }

 private:
  Grid grid_;
  std::vector<Run> runs_;
  std::vector<std::size_t> row_begin_;      // height + 1
  std::vector<std::int64_t> first_active_;  // height + 1
};

// The windows of the pixels first.x <= x < first.x + width, first.y <= y < first.y + height together, grown by kGrowth:
// clear of the boundary (none, all) or perhaps not (partial). One pixel: whether it is active.
Cover classify(const TestImage& scene, double radius, Pixel first, int width = 1, int height = 1);

// Active pixels of an image: each is held with its exact value, bound and samples' estimate.
inline constexpr std::int64_t kMaxActivePixels = std::int64_t{1} << 27;

// Throws Error for more than kMaxActivePixels.
ActiveRows enumerate(const TestImage& scene, double radius);

// Calls f(x, y, index) for every active pixel, row-major; index counts from 0.
template <class F>
void for_each_active(const ActiveRows& rows, F&& f) {
  std::int64_t index = 0;
  for (int y = 0; y < rows.grid().height; ++y)
    for (const Run& r : rows.row(y))
      if (r.cover == Cover::partial)
        for (std::int32_t x = r.x0; x < r.x1; ++x) f(x, y, index++);
}

}  // namespace moire
