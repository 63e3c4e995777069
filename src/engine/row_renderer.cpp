// Rows of cells; see row_renderer.h.
#include "engine/row_renderer.h"

#include <algorithm>

#include "engine/tree_cells.h"

namespace moire {
namespace {

// Points generated and tested at a time, unless one pixel has more.
constexpr int kBatch = 1024;

}  // namespace

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

std::size_t CellRow::index(int x) const {
  const auto it =
      std::upper_bound(cells.begin(), cells.end(), x, [](int v, const PixelInterval& c) { return v < c.x1; });
  if (it == cells.end() || x < it->x0) return kNone;
  return first[static_cast<std::size_t>(it - cells.begin())] + static_cast<std::size_t>(x - it->x0);
}

RowRenderer::RowRenderer(const TestImage& scene, Samples samples, const Filter& filter, const Wanted& wanted, Grid grid,
                         Estimator estimator, bool exhaustive)
    : scene_(scene),
      samples_(samples),
      filter_(filter),
      reach_(filter.apron()),
      side_(static_cast<std::size_t>(2 * reach_ + 1)),
      wanted_(wanted),
      grid_(grid),
      estimator_(estimator),
      exhaustive_(exhaustive) {
  const bool any = std::any_of(wanted.begin(), wanted.end(), [](const auto& row) { return !row.empty(); });
  if (!any || scene.moves() || !samples.same_in_all_pixels()) return;
  if (!WeightTree::fits(samples.pattern()->n(), reach_, filter.info().symmetry())) return;
  RowSamples points;
  samples.get(0, 1, 0, points);
  tree_.emplace(filter, points.x, points.y);
}

CellRow RowRenderer::cell_row(int y) const {
  std::vector<PixelInterval> all;
  for (int j = std::max(0, y - reach_); j <= std::min(grid_.height - 1, y + reach_); ++j) {
    for (const PixelInterval& w : wanted_[static_cast<std::size_t>(j)]) all.push_back({w.x0 - reach_, w.x1 + reach_});
  }
  std::sort(all.begin(), all.end(), [](const PixelInterval& a, const PixelInterval& b) { return a.x0 < b.x0; });
  CellRow row;
  for (const PixelInterval& c : all) {
    if (!row.cells.empty() && c.x0 <= row.cells.back().x1) {
      row.cells.back().x1 = std::max(row.cells.back().x1, c.x1);
    } else {
      row.cells.push_back(c);
    }
  }
  // With a tree these cells cost no more than the look that tells them.
  if (estimator_ == Estimator::unnormalised && !exhaustive_ && !tree_) row.cells = not_empty(row.cells, y);
  std::size_t count = 0;
  for (const PixelInterval& c : row.cells) {
    row.first.push_back(count);
    count += static_cast<std::size_t>(c.x1 - c.x0);
  }
  row.own.resize(count);
  return row;
}

std::int64_t RowRenderer::bytes(const CellRow& row) const {
  return static_cast<std::int64_t>(row.own.size() * (sizeof(OwnCount) + side_ * side_ * sizeof(WeightSum)));
}

void RowRenderer::sample(int y, CellRow& row) const {
  row.sums.resize(row.own.size() * side_ * side_);
  if (tree_) {
    sample_by_tree(y, row);
  } else {
    sample_all(y, row);
  }
}

// Generates, tests and sums all samples.
void RowRenderer::sample_all(int y, CellRow& row) const {
  const int together = std::max(1, static_cast<int>(kBatch / std::max(1.0, samples_.density())));
  RowSamples samples;
  const bool moves = scene_.moves();
  std::vector<std::uint8_t> inside, needed(side_ * side_);
  CellSums sum(filter_);
  for (std::size_t i = 0; i < row.cells.size(); ++i) {
    for (int x = row.cells[i].x0; x < row.cells[i].x1; x += together) {
      const int end = std::min(row.cells[i].x1, x + together);
      samples_.get(x, end, y, samples, moves);
      inside.resize(samples.x.size());
      row.tested += static_cast<std::int64_t>(samples.x.size());
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

void RowRenderer::sample_by_tree(int y, CellRow& row) const {
  TreeCells cells(scene_, *tree_);
  std::size_t at = 0;
  for (const PixelInterval& c : row.cells) {
    for (int x = c.x0; x < c.x1; ++x, ++at) {
      const std::span<WeightSum> sums(row.sums.data() + at * side_ * side_, side_ * side_);
      row.tested +=
          exhaustive_ ? cells.test_all({x, y}, sums, row.own[at]) : cells.test_crossed({x, y}, sums, row.own[at]);
    }
  }
}

Estimate RowRenderer::estimate(int x, int y, std::span<const CellRow* const> rows) const {
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
    return own.samples > 0 ? static_cast<double>(own.inside) / static_cast<double>(own.samples) : inside_center({x, y});
  });
}

// The cells of row y that may hold something of the scene.
std::vector<PixelInterval> RowRenderer::not_empty(const std::vector<PixelInterval>& cells, int y) const {
  std::vector<PixelInterval> kept;
  for (const PixelInterval& c : cells) {
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
double RowRenderer::inside_center(Pixel pixel) const {
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
void RowRenderer::mark_needed(int x, int y, std::span<std::uint8_t> needed) const {
  std::fill(needed.begin(), needed.end(), std::uint8_t{0});
  for (int dy = -reach_; dy <= reach_; ++dy) {
    if (y + dy < 0 || y + dy >= grid_.height) continue;
    const auto& row = wanted_[static_cast<std::size_t>(y + dy)];
    auto it =
        std::upper_bound(row.begin(), row.end(), x - reach_, [](int v, const PixelInterval& w) { return v < w.x1; });
    for (; it != row.end() && it->x0 <= x + reach_; ++it) {
      for (int p = std::max(it->x0, x - reach_); p < std::min(it->x1, x + reach_ + 1); ++p) {
        needed[static_cast<std::size_t>(dy + reach_) * side_ + static_cast<std::size_t>(p - x + reach_)] = 1;
      }
    }
  }
}

}  // namespace moire
