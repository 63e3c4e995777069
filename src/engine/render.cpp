// Cells are sampled and summed row by row, each once, in bands that fit in memory; pixels are reconstructed as soon as
// the cell rows that their windows touch are there. A band's rows are done in parallel, each into its own slots.
#include "engine/render.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <deque>
#include <string>

#include "core/error.h"
#include "core/names.h"
#include "core/parallel.h"
#include "engine/box_render.h"
#include "engine/importance_render.h"
#include "engine/row_renderer.h"

namespace moire {
namespace {

// Sums kept for a band of cell rows, bytes: enough work for all threads, little beside any image.
constexpr std::int64_t kBandBytes = 16 << 20;

// Whether pixel x of a row is active; `runs` covers the row.
bool is_active(std::span<const Run> runs, int x) {
  const auto it = std::upper_bound(runs.begin(), runs.end(), x, [](int v, const Run& r) { return v < r.x1; });
  return it != runs.end() && it->cover == Cover::partial;
}

}  // namespace

void require_renderable(Grid grid, const Filter& filter, Estimator estimator, std::int64_t spp,
                        std::string_view place) {
  const bool shared = !is_importance(estimator);
  const double apron = shared ? filter.apron() : 0;
  const double width = grid.width + 2 * apron, height = grid.height + 2 * apron;
  const double samples = width * height * static_cast<double>(spp);
  if (samples > 0x1p53) {
    throw Error(std::string(place),
                "an image of " + shortest(samples) + " samples; at most 2^53, so fewer pixels or samples");
  }
  if (!shared) return;
  // Sums of side x side pixels for each cell, side rows of cells at a time: all of them for an edge along a row.
  const double side = 2 * apron + 1, bytes = side * side * side * width * sizeof(WeightSum);
  if (bytes > 0x1p33) {
    throw Error(std::string(place), "filter \"" + filter.text() + "\" on a row of " + std::to_string(grid.width) +
                                        " pixels may need " + shortest(std::ceil(bytes * 0x1p-30)) +
                                        " GiB; at most 8, so a smaller radius or width");
  }
}

Rendered render(const TestImage& scene, Samples samples, const Filter& filter, Estimator estimator,
                const ActiveRows& rows, bool exhaustive) {
  assert(!scene.moves() || samples.has_time());
  if (samples.pattern() != nullptr && filter.is_unit_box() && !scene.moves()) {
    // The window is the pixel and all weights are 1: importance samples are the pixel's own, and their mean the ratio.
    const Estimator same = is_importance(estimator) ? Estimator::ratio : estimator;
    return render_box(scene, *samples.pattern(), same, rows, exhaustive);
  }
  if (is_importance(estimator)) {
    assert(samples.pattern() != nullptr);
    return render_importance(scene, *samples.pattern(), filter, estimator, rows, exhaustive);
  }
  const Grid grid = rows.grid();
  const int reach = filter.apron();
  Rendered out;
  out.pixels = rendered_pixels(estimator, exhaustive);
  out.samples_total = samples.total(grid, reach);
  const Wanted wanted = wanted_pixels(rows, out.pixels);
  std::vector<std::size_t> first_value{0};  // of each row
  for (const auto& row : wanted) {
    std::size_t count = first_value.back();
    for (const PixelInterval& w : row) count += static_cast<std::size_t>(w.x1 - w.x0);
    first_value.push_back(count);
  }
  out.value.resize(first_value.back());
  const RowRenderer renderer(scene, samples, filter, wanted, grid, estimator, exhaustive);
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
    }
    parallel_for(static_cast<std::size_t>(next_cell - band_begin), [&](std::size_t i) {
      const int y = band_begin + static_cast<int>(i);
      renderer.sample(y, cells[static_cast<std::size_t>(y - first_cell)]);
    });
    for (int y = band_begin; y < next_cell; ++y) {
      out.samples_evaluated += cells[static_cast<std::size_t>(y - first_cell)].tested;
    }
    const int ready = next_cell - reach;  // pixel rows below this one have all their cells
    parallel_for(static_cast<std::size_t>(std::max(0, ready - next_pixel)), [&](std::size_t i) {
      const int y = next_pixel + static_cast<int>(i);
      std::vector<const CellRow*> around;
      for (int j = y - reach; j <= y + reach; ++j) around.push_back(&cells[static_cast<std::size_t>(j - first_cell)]);
      std::size_t index = first_value[static_cast<std::size_t>(y)];
      for (const PixelInterval& w : wanted[static_cast<std::size_t>(y)]) {
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
