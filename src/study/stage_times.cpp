// What sampling costs by stage.
#include "study/stage_times.h"

#include <algorithm>

#include "engine/cell_sums.h"
#include "study/stopwatch.h"

namespace moire {
namespace {

constexpr int kBlock = 1024;  // samples made together, unless one cell has more: as in render()

// Cells that are filled together.
int cells_together(const Samples& samples) {
  return std::max(1, static_cast<int>(kBlock / std::max(1.0, samples.density())));
}

bool is_active(const ActiveRows& rows, int x, int y) {
  if (x < 0 || x >= rows.grid().width || y < 0 || y >= rows.grid().height) return false;
  const auto runs = rows.row(y);
  const auto it = std::upper_bound(runs.begin(), runs.end(), x, [](int v, const Run& r) { return v < r.x1; });
  return it->cover == Cover::partial;
}

}  // namespace

ActiveCells::ActiveCells(const ActiveRows& rows, int reach)
    : reach_(reach), side_(static_cast<std::size_t>(2 * reach + 1)) {
  const int height = rows.grid().height;
  std::vector<Run> grown;
  for (int y = -reach; y < height + reach; ++y) {
    grown.clear();
    for (int j = std::max(0, y - reach); j <= std::min(height - 1, y + reach); ++j) {
      for (const Run& r : rows.row(j)) {
        if (r.cover == Cover::partial) grown.push_back({r.x0 - reach, r.x1 + reach, r.cover});
      }
    }
    std::sort(grown.begin(), grown.end(), [](const Run& a, const Run& b) { return a.x0 < b.x0; });
    const std::size_t first_stretch = stretches_.size();
    for (const Run& r : grown) {
      if (stretches_.size() > first_stretch && r.x0 <= stretches_.back().x1) {
        stretches_.back().x1 = std::max(stretches_.back().x1, r.x1);
      } else {
        stretches_.push_back({r.x0, r.x1, y, 0});
      }
    }
    for (std::size_t i = first_stretch; i < stretches_.size(); ++i) {
      stretches_[i].first = size();
      for (int x = stretches_[i].x0; x < stretches_[i].x1; ++x) {
        for (int dy = -reach; dy <= reach; ++dy) {
          for (int dx = -reach; dx <= reach; ++dx) needed_.push_back(is_active(rows, x + dx, y + dy));
        }
      }
    }
  }
}

std::int64_t time_generation(Samples samples, const ActiveCells& cells, bool with_time) {
  const int together = cells_together(samples);
  RowSamples block;
  const Stopwatch time;
  for (const ActiveCells::Stretch& s : cells.stretches()) {
    for (int x = s.x0; x < s.x1; x += together) {
      samples.get(x, std::min(s.x1, x + together), s.y, block, with_time);
    }
  }
  return time.nanoseconds();
}

StageTimes time_stages(const TestImage& scene, Samples samples, const Filter& filter, const ActiveCells& cells) {
  const int together = cells_together(samples);
  const bool moves = scene.moves();
  StageTimes times;
  RowSamples block;
  std::vector<std::uint8_t> inside;
  CellSums sum(filter);
  const auto side = static_cast<std::size_t>(2 * cells.reach() + 1);
  std::vector<WeightSum> sums(side * side);
  OwnCount own;
  std::int64_t looks_ns = 0;  // of one look at the clock per block
  for (const ActiveCells::Stretch& s : cells.stretches()) {
    for (int x = s.x0; x < s.x1; x += together) {
      const int end = std::min(s.x1, x + together);
      const Stopwatch time;
      const std::int64_t begun = time.nanoseconds();
      samples.get(x, end, s.y, block, moves);
      const std::int64_t made = time.nanoseconds();
      inside.resize(block.x.size());
      if (!block.x.empty() && moves) {
        scene.contains_at(block.pixels, block.x, block.y, block.t, inside);
      } else if (!block.x.empty()) {
        scene.contains(block.pixels, block.x, block.y, inside);
      }
      const std::int64_t tested = time.nanoseconds();
      for (int cell = x; cell < end; ++cell) {
        const std::size_t from = block.first[static_cast<std::size_t>(cell - x)],
                          n = block.first[static_cast<std::size_t>(cell - x) + 1] - from;
        sum({block.x.data() + from, n}, {block.y.data() + from, n}, {inside.data() + from, n},
            cells.needed(s.first + static_cast<std::size_t>(cell - s.x0)), sums, own);
      }
      const std::int64_t weighed = time.nanoseconds();
      times.samples += static_cast<std::int64_t>(block.x.size());
      looks_ns += begun;
      times.generation_ns += made - begun;
      times.evaluation_ns += tested - made;
      times.reconstruction_ns += weighed - tested;
    }
  }
  for (std::int64_t* stage : {&times.generation_ns, &times.evaluation_ns, &times.reconstruction_ns}) {
    *stage = std::max<std::int64_t>(0, *stage - looks_ns);
  }
  return times;
}

}  // namespace moire
