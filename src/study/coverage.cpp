// Images against box coverage, over the union of two sets of active pixels. A filter narrower than a pixel has flat
// windows where coverage is partial; a wide one has active pixels where coverage is flat.
#include "study/coverage.h"

#include <algorithm>
#include <cassert>
#include <vector>

namespace moire {
namespace {

struct Compared {
  std::int32_t x = 0;
  double got = 0, coverage = 0;
  bool active = false;
};

double flat_value(Cover cover) { return cover == Cover::all ? 1.0 : 0.0; }

// The runs of one row, asked from left to right.
class RowCursor {
 public:
  RowCursor(const ActiveRows& rows, int y) : runs_(rows.row(y)), index_(rows.first_active(y)) {}

  // The run that holds pixel x, and the index of x among the active pixels if that run is active.
  const Run& at(std::int32_t x) {
    for (; runs_[run_].x1 <= x; ++run_) {
      if (runs_[run_].cover == Cover::partial) index_ += runs_[run_].x1 - runs_[run_].x0;
    }
    return runs_[run_];
  }
  std::size_t index(std::int32_t x) const { return static_cast<std::size_t>(index_ + (x - runs_[run_].x0)); }

 private:
  std::span<const Run> runs_;
  std::size_t run_ = 0;
  std::int64_t index_;
};

// Adds what the box alone sees in the row, in order of x.
void add_box_alone(const ActiveRows& rows, Pixels rendered, const Truth& box, int y, std::vector<Compared>& row) {
  const std::size_t before = row.size();
  RowCursor mine(rows, y), boxes(box.rows, y);
  for (const Run& run : box.rows.row(y)) {
    if (run.cover != Cover::partial) continue;
    for (std::int32_t x = run.x0; x < run.x1; ++x) {
      const Cover cover = mine.at(x).cover;
      if (is_rendered(rendered, cover)) continue;
      boxes.at(x);
      row.push_back({x, flat_value(cover), box.exact.value[boxes.index(x)], true});
    }
  }
  if (row.size() > before) {
    std::sort(row.begin(), row.end(), [](const Compared& a, const Compared& b) { return a.x < b.x; });
  }
}

}  // namespace

CoverageErrors coverage_errors(const ActiveRows& rows, const Rendered& got, const Truth& box) {
  const Grid grid = rows.grid();
  ErrorTally active, all;
  std::int64_t counted = 0;
  std::size_t next = 0;
  std::vector<Compared> row;
  for (int y = 0; y < grid.height; ++y) {
    row.clear();
    RowCursor boxes(box.rows, y);
    for (const Run& run : rows.row(y)) {
      if (!is_rendered(got.pixels, run.cover)) continue;
      for (std::int32_t x = run.x0; x < run.x1; ++x) {
        const bool partial = boxes.at(x).cover == Cover::partial;
        row.push_back({x, got.value[next++], partial ? box.exact.value[boxes.index(x)] : flat_value(boxes.at(x).cover),
                       partial || run.cover == Cover::partial});
      }
    }
    add_box_alone(rows, got.pixels, box, y, row);
    for (const Compared& c : row) {
      all.add(c.x, y, c.got, c.coverage);
      if (c.active) active.add(c.x, y, c.got, c.coverage);
    }
    counted += static_cast<std::int64_t>(row.size());
  }
  assert(next == got.value.size());
  all.add_exact(std::int64_t{grid.width} * grid.height - counted);
  return {active.finish(), all.finish()};
}

}  // namespace moire
