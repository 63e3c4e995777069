#include "engine/active_rows.h"

#include <algorithm>
#include <cassert>

namespace moire {
namespace {

// A block of pixels x0 <= x < x1, y0 <= y < y1.
struct Block {
  int x0, x1, y0, y1;
};

class Enumerator {
 public:
  Enumerator(const TestImage& scene, double radius, std::vector<std::vector<Run>>& rows)
      : scene_(scene), radius_(radius), rows_(rows) {}

  // Blocks are visited so that each row receives its runs from left to right.
  void visit(const Block& b) {
    const int width = b.x1 - b.x0, height = b.y1 - b.y0;
    const Cover cover = classify(scene_, radius_, {b.x0, b.y0}, width, height);
    if (cover != Cover::partial || (width == 1 && height == 1)) {
      for (int y = b.y0; y < b.y1; ++y) append(y, {b.x0, b.x1, cover});
      return;
    }
    if (width >= height) {
      const int mid = b.x0 + width / 2;
      visit({b.x0, mid, b.y0, b.y1});
      visit({mid, b.x1, b.y0, b.y1});
    } else {
      const int mid = b.y0 + height / 2;
      visit({b.x0, b.x1, b.y0, mid});
      visit({b.x0, b.x1, mid, b.y1});
    }
  }

 private:
  void append(int y, Run run) {
    std::vector<Run>& row = rows_[static_cast<std::size_t>(y)];
    if (!row.empty() && row.back().cover == run.cover) {
      row.back().x1 = run.x1;
    } else {
      row.push_back(run);
    }
  }

  const TestImage& scene_;
  double radius_;
  std::vector<std::vector<Run>>& rows_;
};

}  // namespace

Cover classify(const TestImage& scene, double radius, Pixel first, int width, int height) {
  const double reach = radius + kGrowth;
  return scene.cover(first, {{0.5 - reach, 0.5 - reach}, {width - 0.5 + reach, height - 0.5 + reach}});
}

ActiveRows::ActiveRows(Grid grid, std::vector<Run> runs, std::vector<std::size_t> row_begin)
    : grid_(grid), runs_(std::move(runs)), row_begin_(std::move(row_begin)) {
  assert(row_begin_.size() == static_cast<std::size_t>(grid_.height) + 1);
  first_active_.reserve(row_begin_.size());
  std::int64_t active = 0;
  for (int y = 0; y < grid_.height; ++y) {
    first_active_.push_back(active);
    for (const Run& r : row(y)) {
      if (r.cover == Cover::partial) active += r.x1 - r.x0;
    }
  }
  first_active_.push_back(active);
}

std::span<const Run> ActiveRows::row(int y) const noexcept {
  const auto i = static_cast<std::size_t>(y);
  return std::span(runs_).subspan(row_begin_[i], row_begin_[i + 1] - row_begin_[i]);
}

ActiveRows enumerate(const TestImage& scene, double radius) {
  const Grid grid = scene.grid();
  std::vector<std::vector<Run>> rows(static_cast<std::size_t>(grid.height));
  Enumerator(scene, radius, rows).visit({0, grid.width, 0, grid.height});
  std::vector<Run> runs;
  std::vector<std::size_t> row_begin{0};
  for (const auto& row : rows) {
    runs.insert(runs.end(), row.begin(), row.end());
    row_begin.push_back(runs.size());
  }
  return ActiveRows(grid, std::move(runs), std::move(row_begin));
}

}  // namespace moire
