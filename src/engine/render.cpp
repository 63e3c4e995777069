// Cells are sampled and summed row by row, each once, in bands that fit in memory; pixels are reconstructed as soon as
// the cell rows that their windows touch are there. A band's rows are done in parallel, each into its own slots.
#include "engine/render.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <deque>
#include <string>

#include "core/error.h"
#include "core/names.h"
#include "core/parallel.h"
#include "engine/box_render.h"
#include "engine/cell_sums.h"
#include "engine/estimate.h"

namespace moire {
namespace {

constexpr auto kEstimatorNames = std::to_array<std::string_view>({"ratio", "unnormalised", "control-variate"});

// Points generated and tested at a time, unless one pixel has more.
constexpr int kBatch = 1024;
// Sums kept for a band of cell rows, bytes: enough work for all threads, little beside any image.
constexpr std::int64_t kBandBytes = 16 << 20;

// Pixels x0 <= x < x1.
struct Interval {
  int x0, x1;
};

// The pixels of each row that are reconstructed, as sorted disjoint intervals.
using Wanted = std::vector<std::vector<Interval>>;

Wanted wanted_pixels(const ActiveRows& rows, Pixels pixels) {
  Wanted wanted(static_cast<std::size_t>(rows.grid().height));
  for (int y = 0; y < rows.grid().height; ++y) {
    auto& row = wanted[static_cast<std::size_t>(y)];
    for (const Run& r : rows.row(y)) {
      if (!is_rendered(pixels, r.cover)) continue;
      if (!row.empty() && row.back().x1 == r.x0) {
        row.back().x1 = r.x1;
      } else {
        row.push_back({r.x0, r.x1});
      }
    }
  }
  return wanted;
}

// One row of cells whose samples are needed, with their sums.
struct CellRow {
  std::vector<Interval> cells;
  std::vector<std::size_t> first;  // of each interval, in cells
  std::vector<WeightSum> sums;     // side * side per cell
  std::vector<OwnCount> own;

  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);

  // Where the cell's sums are; kNone for a cell that was skipped, whose samples are all outside the scene.
  std::size_t index(int x) const {
    const auto it = std::upper_bound(cells.begin(), cells.end(), x, [](int v, const Interval& c) { return v < c.x1; });
    if (it == cells.end() || x < it->x0) return kNone;
    return first[static_cast<std::size_t>(it - cells.begin())] + static_cast<std::size_t>(x - it->x0);
  }
};

class Renderer {
 public:
  Renderer(const TestImage& scene, Samples samples, const Filter& filter, const Wanted& wanted, Grid grid,
           Estimator estimator, bool skip_empty_cells)
      : scene_(scene),
        samples_(samples),
        kernel_(filter.kernel()),
        reach_(filter.apron()),
        side_(static_cast<std::size_t>(2 * reach_ + 1)),
        wanted_(wanted),
        grid_(grid),
        estimator_(estimator),
        skip_empty_cells_(skip_empty_cells) {}

  // The cells of row y that the windows of wanted pixels touch.
  CellRow cell_row(int y) const {
    std::vector<Interval> all;
    for (int j = std::max(0, y - reach_); j <= std::min(grid_.height - 1, y + reach_); ++j) {
      for (const Interval& w : wanted_[static_cast<std::size_t>(j)]) all.push_back({w.x0 - reach_, w.x1 + reach_});
    }
    std::sort(all.begin(), all.end(), [](const Interval& a, const Interval& b) { return a.x0 < b.x0; });
    CellRow row;
    for (const Interval& c : all) {
      if (!row.cells.empty() && c.x0 <= row.cells.back().x1) {
        row.cells.back().x1 = std::max(row.cells.back().x1, c.x1);
      } else {
        row.cells.push_back(c);
      }
    }
    if (skip_empty_cells_) row.cells = not_empty(row.cells, y);
    std::size_t count = 0;
    for (const Interval& c : row.cells) {
      row.first.push_back(count);
      count += static_cast<std::size_t>(c.x1 - c.x0);
    }
    row.own.resize(count);
    return row;
  }

  // Samples of a row's cells.
  std::int64_t count(int y, const CellRow& row) const {
    std::int64_t count = 0;
    for (const Interval& c : row.cells) count += samples_.count(c.x0, c.x1, y);
    return count;
  }

  std::int64_t bytes(const CellRow& row) const {
    return static_cast<std::int64_t>(row.own.size() * (sizeof(OwnCount) + side_ * side_ * sizeof(WeightSum)));
  }

  // Generates, tests and sums the samples of a row's cells.
  void sample(int y, CellRow& row) const {
    const int together = std::max(1, static_cast<int>(kBatch / std::max(1.0, samples_.density())));
    RowSamples samples;
    const bool moves = scene_.moves();
    std::vector<std::uint8_t> inside, needed(side_ * side_);
    CellSums sum(kernel_, reach_);
    row.sums.resize(row.own.size() * side_ * side_);
    for (std::size_t i = 0; i < row.cells.size(); ++i) {
      for (int x = row.cells[i].x0; x < row.cells[i].x1; x += together) {
        const int end = std::min(row.cells[i].x1, x + together);
        samples_.get(x, end, y, samples, moves);
        inside.resize(samples.x.size());
        if (!samples.x.empty() && moves) {
          scene_.contains_at(samples.pixels, samples.x, samples.y, samples.t, inside);
        } else if (!samples.x.empty()) {
          scene_.contains(samples.pixels, samples.x, samples.y, inside);
        }
        for (int cell = x; cell < end; ++cell) {
          const auto c = static_cast<std::size_t>(cell - x);
          const std::size_t at = row.first[i] + static_cast<std::size_t>(cell - row.cells[i].x0);
          const std::size_t from = samples.first[c], n = samples.first[c + 1] - from;
          mark_needed(cell, y, needed);
          sum({samples.x.data() + from, n}, {samples.y.data() + from, n}, {inside.data() + from, n}, needed,
              {row.sums.data() + at * side_ * side_, side_ * side_}, row.own[at]);
        }
      }
    }
  }

  // Pixel (x, y) from the sums over all cells that its window touches; `rows` are the cell rows y - reach to y + reach.
  Estimate estimate(int x, int y, std::span<const CellRow* const> rows) const {
    double k = 0, kf = 0;
    for (std::size_t j = 0; j < side_; ++j) {
      for (std::size_t i = 0; i < side_; ++i) {
        const std::size_t cell = rows[j]->index(x - reach_ + static_cast<int>(i));
        if (cell == CellRow::kNone) continue;
        // Seen from the cell, the pixel lies at the opposite offset.
        const WeightSum& s = rows[j]->sums[cell * side_ * side_ + (side_ - 1 - j) * side_ + (side_ - 1 - i)];
        k += s.k;
        kf += s.kf;
      }
    }
    return moire::estimate(estimator_, {k, kf}, samples_.density(), [&] {
      const CellRow& own_row = *rows[static_cast<std::size_t>(reach_)];
      const OwnCount& own = own_row.own[own_row.index(x)];
      return own.samples > 0 ? static_cast<double>(own.inside) / static_cast<double>(own.samples)
                             : inside_center({x, y});
    });
  }

 private:
  // The cells of row y that may hold something of the scene.
  std::vector<Interval> not_empty(const std::vector<Interval>& cells, int y) const {
    std::vector<Interval> kept;
    for (const Interval& c : cells) {
      for (int x = c.x0; x < c.x1; ++x) {
        if (scene_.cover({x, y}, {{0, 0}, {1, 1}}) == Cover::none) continue;
        if (!kept.empty() && kept.back().x1 == x) {
          ++kept.back().x1;
        } else {
          kept.push_back({x, x + 1});
        }
      }
    }
    return kept;
  }

  // In the middle of the time, too.
  double inside_center(Pixel pixel) const {
    const double center = 0.5;
    std::uint8_t inside = 0;
    if (scene_.moves()) {
      scene_.contains_at({&pixel, 1}, {&center, 1}, {&center, 1}, {&center, 1}, {&inside, 1});
    } else {
      scene_.contains({&pixel, 1}, {&center, 1}, {&center, 1}, {&inside, 1});
    }
    return inside;
  }

  // Which pixels around the cell (x, y) are wanted.
  void mark_needed(int x, int y, std::span<std::uint8_t> needed) const {
    std::fill(needed.begin(), needed.end(), std::uint8_t{0});
    for (int dy = -reach_; dy <= reach_; ++dy) {
      if (y + dy < 0 || y + dy >= grid_.height) continue;
      const auto& row = wanted_[static_cast<std::size_t>(y + dy)];
      auto it = std::upper_bound(row.begin(), row.end(), x - reach_, [](int v, const Interval& w) { return v < w.x1; });
      for (; it != row.end() && it->x0 <= x + reach_; ++it) {
        for (int p = std::max(it->x0, x - reach_); p < std::min(it->x1, x + reach_ + 1); ++p) {
          needed[static_cast<std::size_t>(dy + reach_) * side_ + static_cast<std::size_t>(p - x + reach_)] = 1;
        }
      }
    }
  }

  const TestImage& scene_;
  Samples samples_;
  const Kernel& kernel_;
  int reach_;
  std::size_t side_;
  const Wanted& wanted_;
  Grid grid_;
  Estimator estimator_;
  bool skip_empty_cells_;
};

// Whether pixel x of a row is active; `runs` covers the row.
bool is_active(std::span<const Run> runs, int x) {
  const auto it = std::upper_bound(runs.begin(), runs.end(), x, [](int v, const Run& r) { return v < r.x1; });
  return it != runs.end() && it->cover == Cover::partial;
}

}  // namespace

std::span<const std::string_view> estimator_names() { return kEstimatorNames; }

Estimator find_estimator(std::string_view name, std::string_view place) {
  for (std::size_t i = 0; i < kEstimatorNames.size(); ++i) {
    if (kEstimatorNames[i] == name) return static_cast<Estimator>(i);
  }
  throw Error(std::string(place), unknown_name("estimator", name, kEstimatorNames));
}

void require_renderable(Grid grid, const Filter& filter, std::int64_t spp, std::string_view place) {
  const double width = grid.width + 2.0 * filter.apron(), height = grid.height + 2.0 * filter.apron();
  const double samples = width * height * static_cast<double>(spp);
  if (samples > 0x1p53) {
    throw Error(std::string(place),
                "an image of " + shortest(samples) + " samples; at most 2^53, so fewer pixels or samples");
  }
  // Sums of side x side pixels for each cell, side rows of cells at a time: all of them for an edge along a row.
  const double side = 2.0 * filter.apron() + 1, bytes = side * side * side * width * sizeof(WeightSum);
  if (bytes > 0x1p33) {
    throw Error(std::string(place), "filter \"" + filter.text() + "\" on a row of " + std::to_string(grid.width) +
                                        " pixels may need " + shortest(std::ceil(bytes * 0x1p-30)) +
                                        " GiB; at most 8, so a smaller radius or width");
  }
}

Rendered render(const TestImage& scene, Samples samples, const Filter& filter, Estimator estimator,
                const ActiveRows& rows, bool exhaustive) {
  assert(!scene.moves() || samples.has_time());
  if (samples.pattern() != nullptr && filter.kernel().is_unit_box() && !scene.moves()) {
    return render_box(scene, *samples.pattern(), estimator, rows, exhaustive);
  }
  const Grid grid = rows.grid();
  const int reach = filter.apron();
  Rendered out;
  const bool linear = estimator == Estimator::unnormalised;
  out.pixels = rendered_pixels(estimator, exhaustive);
  out.samples_total = samples.total(grid, reach);
  const Wanted wanted = wanted_pixels(rows, out.pixels);
  std::vector<std::size_t> first_value{0};  // of each row
  for (const auto& row : wanted) {
    std::size_t count = first_value.back();
    for (const Interval& w : row) count += static_cast<std::size_t>(w.x1 - w.x0);
    first_value.push_back(count);
  }
  out.value.resize(first_value.back());
  const Renderer renderer(scene, samples, filter, wanted, grid, estimator, linear && !exhaustive);
  std::vector<std::int64_t> fallbacks(static_cast<std::size_t>(grid.height));
  std::deque<CellRow> cells;  // rows first_cell .. next_cell - 1
  int first_cell = -reach, next_cell = -reach, next_pixel = 0;
  while (next_pixel < grid.height) {
    // Take cell rows until the band is full.
    const int band_begin = next_cell;
    std::int64_t bytes = 0;
    while (next_cell < grid.height + reach && (bytes == 0 || bytes < kBandBytes)) {
      cells.push_back(renderer.cell_row(next_cell++));
      bytes += renderer.bytes(cells.back());
      out.samples_evaluated += renderer.count(next_cell - 1, cells.back());
    }
    parallel_for(static_cast<std::size_t>(next_cell - band_begin), [&](std::size_t i) {
      const int y = band_begin + static_cast<int>(i);
      renderer.sample(y, cells[static_cast<std::size_t>(y - first_cell)]);
    });
    const int ready = next_cell - reach;  // pixel rows below this one have all their cells
    parallel_for(static_cast<std::size_t>(std::max(0, ready - next_pixel)), [&](std::size_t i) {
      const int y = next_pixel + static_cast<int>(i);
      std::vector<const CellRow*> around;
      for (int j = y - reach; j <= y + reach; ++j) around.push_back(&cells[static_cast<std::size_t>(j - first_cell)]);
      std::size_t index = first_value[static_cast<std::size_t>(y)];
      for (const Interval& w : wanted[static_cast<std::size_t>(y)]) {
        for (int x = w.x0; x < w.x1; ++x) {
          const auto [value, fallback] = renderer.estimate(x, y, around);
          out.value[index++] = value;
          fallbacks[static_cast<std::size_t>(y)] += fallback && (!exhaustive || is_active(rows.row(y), x));
        }
      }
    });
    next_pixel = std::max(next_pixel, ready);
    while (first_cell < next_pixel - reach) {
      cells.pop_front();
      ++first_cell;
    }
  }
  for (const std::int64_t f : fallbacks) out.fallbacks += f;
  return out;
}

}  // namespace moire
