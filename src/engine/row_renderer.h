// Rows of cells: which of them the windows of wanted pixels touch, their sums, and pixels from the sums around them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/geometry.h"
#include "engine/active_rows.h"
#include "engine/cell_sums.h"
#include "engine/estimate.h"
#include "engine/render.h"
#include "engine/samples.h"
#include "engine/weight_tree.h"
#include "filters/filter.h"
#include "testimages/testimage.h"

namespace moire {

// Pixels x0 <= x < x1 of a row.
struct PixelInterval {
  int x0, x1;
};

// The pixels of each row that are reconstructed, as sorted disjoint intervals.
using Wanted = std::vector<std::vector<PixelInterval>>;

Wanted wanted_pixels(const ActiveRows& rows, Pixels pixels);

// One row of cells whose samples are needed, with their sums.
struct CellRow {
  std::vector<PixelInterval> cells;
  std::vector<std::size_t> first;  // of each interval, in cells
  std::vector<WeightSum> sums;     // side * side per cell
  std::vector<OwnCount> own;
  std::int64_t tested = 0;  // samples

  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);

  // Where the cell's sums are; kNone for a cell that was skipped, whose samples are all outside the scene.
  std::size_t index(int x) const;
};

// All arguments must outlive it; what it does may be done for many rows at once.
class RowRenderer {
 public:
  // Where the same points lie in every cell of a still scene they are weighed once, in a WeightTree, if it fits: that
  // depends on the filter, the pattern and its count alone, and decides in which order a cell's weights are added.
  // `exhaustive` tests every sample.
  RowRenderer(const TestImage& scene, Samples samples, const Filter& filter, const Wanted& wanted, Grid grid,
              Estimator estimator, bool exhaustive);

  // The cells of row y that the windows of wanted pixels touch, yet without sums.
  CellRow cell_row(int y) const;
  // Memory that its sums take.
  std::int64_t bytes(const CellRow& row) const;
  // Sums the samples of a row's cells.
  void sample(int y, CellRow& row) const;
  // Pixel (x, y) from the sums over all cells that its window touches; `rows` are the cell rows y - reach to y + reach.
  Estimate estimate(int x, int y, std::span<const CellRow* const> rows) const;

 private:
  void sample_all(int y, CellRow& row) const;
  void sample_by_tree(int y, CellRow& row) const;
  std::vector<PixelInterval> not_empty(const std::vector<PixelInterval>& cells, int y) const;
  double inside_center(Pixel pixel) const;
  void mark_needed(int x, int y, std::span<std::uint8_t> needed) const;

  const TestImage& scene_;
  Samples samples_;
  const Filter& filter_;
  int reach_;
  std::size_t side_;
  const Wanted& wanted_;
  Grid grid_;
  Estimator estimator_;
  bool exhaustive_;
  std::optional<WeightTree> tree_;
};

}  // namespace moire
