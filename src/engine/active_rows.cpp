#include "engine/active_rows.h"

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <numeric>
#include <string>

#include "core/error.h"

namespace moire {
namespace {

// A block of pixels x0 <= x < x1, y0 <= y < y1.
struct Block {
  int x0, x1, y0, y1;
};

class Enumerator {
 public:
  Enumerator(const TestImage& scene, double radius)
      : scene_(scene), radius_(radius), last_(static_cast<std::size_t>(scene.grid().height), kNone) {}

  // Blocks are visited so that each row receives its runs from left to right.
  void visit(const Block& b) {
    const int width = b.x1 - b.x0, height = b.y1 - b.y0;
    const Cover cover = classify(scene_, radius_, {b.x0, b.y0}, width, height);
    if (cover != Cover::partial || (width == 1 && height == 1)) {
      for (int y = b.y0; y < b.y1; ++y) append(y, {b.x0, b.x1, cover});
      return;
    }
    if (std::int64_t{width} * height <= kSmall) {
      for (int y = b.y0; y < b.y1; ++y)
        for (int x = b.x0; x < b.x1; ++x) append(y, {x, x + 1, classify(scene_, radius_, {x, y})});
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

  // The runs of all rows, row by row.
  ActiveRows rows(Grid grid) const {
    std::vector<std::size_t> row_begin(static_cast<std::size_t>(grid.height) + 1);
    for (const Found& f : found_) ++row_begin[static_cast<std::size_t>(f.y) + 1];
    std::partial_sum(row_begin.begin(), row_begin.end(), row_begin.begin());
    std::vector<Run> runs(found_.size());
    std::vector<std::size_t> next(row_begin.begin(), row_begin.end() - 1);
    for (const Found& f : found_) runs[next[static_cast<std::size_t>(f.y)]++] = f.run;
    return ActiveRows(grid, std::move(runs), std::move(row_begin));
  }

 private:
  // A boundary that meets a block of so few pixels meets about half of them: halving further takes more questions.
  static constexpr int kSmall = 16;
  static constexpr std::size_t kNone = SIZE_MAX;

  void append(int y, Run run) {
    if (run.cover == Cover::partial && (active_ += run.x1 - run.x0) > kMaxActivePixels) {
      throw Error("scene", "the boundary meets more than " + std::to_string(kMaxActivePixels) +
                               " pixels' windows, too many to hold; give a smaller image or filter, or larger squares");
    }
    std::size_t& last = last_[static_cast<std::size_t>(y)];
    if (last != kNone && found_[last].run.cover == run.cover) {
      found_[last].run.x1 = run.x1;
    } else {
      last = found_.size();
      found_.push_back({run, y});
    }
  }

  struct Found {
    Run run;
    int y;
  };
  const TestImage& scene_;
  double radius_;
  std::int64_t active_ = 0;
  std::vector<Found> found_;
  std::vector<std::size_t> last_;  // of each row, in found_
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
  Enumerator enumerator(scene, radius);
  enumerator.visit({0, grid.width, 0, grid.height});
  return enumerator.rows(grid);
}

}  // namespace moire
