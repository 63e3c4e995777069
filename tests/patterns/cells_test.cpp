// Cells: where a pattern says its points are, they are; and taken cell by cell they are the points of fill().
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "patterns/jittered_grid.h"
#include "patterns/pattern.h"
#include "patterns/placed_grid.h"
#include "patterns/point_grid.h"
#include "patterns/variants.h"

using namespace moire;
using namespace moire::test;

namespace {

using Sorted = std::vector<std::pair<double, double>>;

Sorted sorted(const PointSet& set, std::size_t count) {
  Sorted points;
  for (std::size_t i = 0; i < count; ++i) points.emplace_back(set.x[i], set.y[i]);
  std::sort(points.begin(), points.end());
  return points;
}

using Spans = std::span<const CellSpan>;
using Take = std::function<CellPoints(Spans counted, Spans filled, Points out)>;

// What `take(counted, filled, out)` gives for every cell of the grid on its own, and for the whole grid in spans; where
// the points are not in their cells or the counts are not theirs, fails. Returns all points.
Sorted all_by_cells(const CellGrid& grid, int n, const Take& take) {
  PointSet cell = room_for(static_cast<std::size_t>(n), false), all = cell;
  std::size_t have = 0;
  int outside = 0, miscounted = 0;
  const auto in = [](double v, double low, double high) { return v >= low && v <= high; };
  for (int row = 0; row < grid.rows; ++row) {
    for (int column = 0; column < grid.columns; ++column) {
      const CellSpan span{row, column, column + 1};
      const CellPoints points = take({}, {&span, 1}, points_of(cell));
      miscounted += points.counted != 0;
      miscounted += take({&span, 1}, {}, points_of(all).part(0, 0)).counted != static_cast<std::int64_t>(points.filled);
      for (std::size_t i = 0; i < points.filled; ++i) {
        const double x = cell.x[i], y = cell.y[i];
        const auto in_column = [&](int c) {
          return in(x, (c - grid.right) / grid.columns - 0x1p-50, (c + 1 - grid.right) / grid.columns + 0x1p-50);
        };
        const auto in_row = [&](int r) { return in(y, grid.side(r), grid.side(r + 1)); };
        outside += !(in_column(column) || (grid.right > 0 && column == 0 && in_column(grid.columns)));
        outside += !(in_row(row) || (grid.down > 0 && row == 0 && in_row(grid.rows)));
        all.x[have] = x;
        all.y[have++] = y;
      }
    }
    // In stretches of a row.
    for (const int begin : {0, grid.columns / 3}) {
      const int end = std::max(begin, grid.seen_columns() - 1);
      std::int64_t sum = 0;
      for (int c = begin; c < end; ++c) {
        const CellSpan one{row, c, c + 1};
        sum += take({&one, 1}, {}, points_of(cell)).counted;
      }
      const CellSpan span{row, begin, end};
      miscounted += take({&span, 1}, {}, points_of(cell)).counted != sum;
      miscounted += static_cast<std::int64_t>(take({}, {&span, 1}, points_of(cell)).filled) != sum;
    }
  }
  CHECK(outside == 0);
  CHECK(miscounted == 0);
  return sorted(all, have);
}

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("every point is in the cell it is taken from, and all cells together give the points of fill()") {
    int found = 0;
    for (const std::string& text : variants()) {
      const PatternChoice choice = chosen(text);
      for (const int wanted : {64, 72, 100, 256, 300, 1000, 4096}) {
        const int n = usable(choice, wanted);
        const Pattern pattern(choice, n, {.seed = 5, .trial = 2});
        if (!pattern.has_cells()) continue;
        for (const Pixel pixel : {Pixel{0, 0}, Pixel{3, -7}, Pixel{std::int64_t{1} << 40, 12}}) {
          const CellGrid grid = pattern.cells(pixel);
          if (grid.columns == 0) continue;
          ++found;
          CAPTURE(text);
          CAPTURE(n);
          const Sorted by_cells = all_by_cells(grid, n, [&](Spans counted, Spans filled, Points out) {
            return pattern.take_cells(pixel, counted, filled, out);
          });
          PointSet set = room_for(static_cast<std::size_t>(n), false);
          pattern.fill({&pixel, 1}, points_of(set));
          CHECK(by_cells == sorted(set, set.x.size()));
        }
      }
    }
    CHECK(found > 100);
  }

  TEST_CASE("a shifted grid has its points where it says for shifts near lines of cells and at both ends") {
    PointSet set = set_of("hammersley", 256);
    const PointGrid plain(set.x, set.y);
    const double last = 1 - 0x1p-52;
    for (const double x :
         {0.0, 0x1p-52, 0x1p-30, 1.0 / 16, 1.0 / 16 - 0x1p-20, 0.3, 0.5 + 0x1p-22, 1 - 0x1p-10, last}) {
      for (const double y : {0.0, 0x1p-52, 0.25 + 0x1p-23, 0.7, 1 - 1.0 / 32, last}) {
        CAPTURE(x);
        CAPTURE(y);
        const ShiftedGrid shifted(plain, x, y);
        const CellGrid grid = shifted.cells();
        const auto near_line = [](double shift) {
          const double cells = 16 * shift;
          return std::fabs(cells - std::round(cells)) < 0x1p-20;
        };
        CHECK((grid.columns == 0) == (near_line(x) || near_line(y)));
        if (grid.columns == 0) continue;
        const Sorted by_cells = all_by_cells(
            grid, 256, [&](Spans counted, Spans filled, Points out) { return shifted.take(counted, filled, out); });
        PointSet moved = set;
        shift_into(set.x, x, moved.x.data());
        shift_into(set.y, y, moved.y.data());
        CHECK(by_cells == sorted(moved, 256));
      }
    }
  }

  TEST_CASE("a grid of points leaves half a point to two points a cell, and counts every stretch of a row") {
    for (const int n : {1, 2, 7, 31, 32, 127, 128, 511, 4096, 5000}) {
      CAPTURE(n);
      const PointSet set = set_of("random", n);
      const PointGrid grid(set.x, set.y);
      const int cells = grid.side() * grid.side();
      CHECK(2 * n >= cells);
      CHECK(n < 2 * cells);
      int wrong = 0;
      for (int row = 0; row < grid.side(); ++row) {
        for (int begin = 0; begin <= grid.side(); begin += 3) {
          for (int end = begin; end <= grid.side(); end += 2) {
            std::int32_t count = 0;
            for (int i = 0; i < n; ++i) {
              const auto k = static_cast<std::size_t>(i);
              const double column = std::floor(set.x[k] * grid.side());
              count += std::floor(set.y[k] * grid.side()) == row && column >= begin && column < end;
            }
            wrong += grid.count(row, begin, end) != count;
            wrong += grid.points(row, begin, end).size() != static_cast<std::size_t>(count);
          }
        }
      }
      CHECK(wrong == 0);
    }
  }

  TEST_CASE("jittered points are the same bits with every instruction set, and those of their definition") {
    const std::span<const JitteredKernel> kernels = jittered_kernels();
    REQUIRE(!kernels.empty());
    constexpr Grid kGrids[] = {{1, 1},  {2, 2},   {3, 3},   {16, 16},  {15, 15},
                               {23, 1}, {600, 2}, {64, 32}, {1024, 3}, {37, 29}};
    for (const Grid cells_of : kGrids) {
      const int columns = cells_of.width, rows = cells_of.height;
      for (const double amount : {1.0, 0.5, 0.0}) {
        CAPTURE(columns);
        CAPTURE(rows);
        const JitteredGrid grid(columns, rows, amount);
        const Key key = pixel_key(draw_hash(3, 1), {5, -2});
        const auto n = static_cast<std::size_t>(columns * rows);
        PointSet defined = room_for(n, false);
        uniform_points(key, Axis::xy, 0, columns * rows, defined.x.data(), defined.y.data());
        grid.place(defined.x.data(), defined.y.data());
        // Every third cell, and a stretch of each row.
        std::vector<CellSpan> spans;
        std::vector<std::size_t> cells;
        for (int row = 0; row < rows; ++row) {
          for (int column = row % 3; column < columns; column += 3) {
            const int end = std::min(columns, column + 1 + (column % 2));
            spans.push_back({row, column, end});
            for (int c = column; c < end; ++c) cells.push_back(static_cast<std::size_t>(row * columns + c));
          }
        }
        for (const JitteredKernel& kernel : kernels) {
          PointSet set = room_for(n, false);
          kernel.fill(grid, key, set.x.data(), set.y.data());
          CHECK(set == defined);
          PointSet some = room_for(n, false);
          const std::size_t taken = kernel.take(grid, key, spans, some.x.data(), some.y.data());
          REQUIRE(taken == cells.size());
          int different = 0;
          for (std::size_t i = 0; i < taken; ++i) {
            different += some.x[i] != defined.x[cells[i]] || some.y[i] != defined.y[cells[i]];
          }
          CHECK(different == 0);
        }
      }
    }
  }
}
