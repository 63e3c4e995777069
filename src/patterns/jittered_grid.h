// One random point in each cell of a grid: the points of `jittered`, which other patterns give a time.
// R. L. Cook, "Stochastic sampling in computer graphics", ACM TOG 5(1), 1986.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>

#include "core/args.h"
#include "core/geometry.h"
#include "core/hash.h"
#include "patterns/area.h"
#include "patterns/cells.h"
#include "patterns/pattern.h"
#include "patterns/strata.h"
#include "patterns/torus.h"
#include "patterns/uniform.h"

namespace moire {

inline constexpr Param kJitteredParams[] = {
    number("amount", 1, 0, 1, "size of the jitter as a fraction of the cell; 0 is the regular grid"),
    choice(
        "cells", "square", "square|oblong",
        "square cells, n a square; or the grid of n cells in a pixel whose cells are nearest to squares, for any n")};

inline PatternInfo::Counts jittered_count(const Args& args, int n) {
  return args.text("cells") == "square" ? square_count(args, n) : any_count(args, n);
}

// A grid of random points on the unit square: cell (i % columns, i / columns) holds point i.
struct JitteredGrid {
  int columns, rows;
  double amount;
  Strata across, down;

  JitteredGrid(int columns_, int rows_, double amount_)
      : columns(columns_), rows(rows_), amount(amount_), across(columns), down(rows) {}

  // The grid of n cells that are nearest to squares, not higher than wide.
  static JitteredGrid of_pixel(int n, double amount) {
    int rows = static_cast<int>(std::sqrt(static_cast<double>(n)));
    while (n % rows != 0) --rows;
    return {n / rows, rows, amount};
  }

  // The offset in the cell after shrinking towards its middle. Rounding is monotone and the extreme offsets are
  // doubles, so the result stays between them for every amount in [0, 1].
  double jitter(const Strata& strata, double u) const noexcept { return 0.5 + amount * (strata.offset(u) - 0.5); }

  // The points of a pixel, columns * rows of them, from numbers of Axis::xy.
  void fill(const Key& key, double* x, double* y) const noexcept;

  // The same by cells, each of which has one point: see HasCells (pattern.h). With AVX-512, on an edge and a disk, 64
  // points take 250 and 330 ns by cells and 180 and 220 where all are tested; 100, not a power of two, 250 and 450, and
  // 440 and 540; 256 take 330 and 480, and 500 and 590 (tests/bench/box_count.cpp).
  static constexpr int kLeastForCells = 100;
  CellGrid cells() const noexcept { return {columns, rows, 0, 0}; }
  CellPoints take_cells(const Key& key, std::span<const CellSpan> counted, std::span<const CellSpan> filled,
                        Points out) const noexcept;

  // x and y hold uniform numbers and become the points.
  void place(double* __restrict x, double* __restrict y) const noexcept {
    for (int row = 0; row < rows; ++row) {
      for (int column = 0; column < columns; ++column) x[column] = across.place(column, jitter(across, x[column]));
      for (int column = 0; column < columns; ++column) y[column] = down.place(row, jitter(down, y[column]));
      x += columns;
      y += columns;
    }
  }
};

// What fills pixels, for one instruction set; all give the same bits.
struct JitteredKernel {
  void (*fill)(const JitteredGrid& grid, const Key& key, double* x, double* y) noexcept;
  // The points of the cells, in their order; returns how many.
  std::size_t (*take)(const JitteredGrid& grid, const Key& key, std::span<const CellSpan> cells, double* x,
                      double* y) noexcept;
};

// Those that this machine can run, the fastest last.
std::span<const JitteredKernel> jittered_kernels();

// The grid over a whole image.
struct JitteredArea {
  // Columns of the grid over the area whose n cells would be square.
  static std::int64_t ideal_columns(Grid area, std::int64_t n) {
    return std::max<std::int64_t>(1, std::llround(std::sqrt(static_cast<double>(n) * area.width / area.height)));
  }
  static std::int64_t count(const Args&, Grid area, std::int64_t n) {
    const std::int64_t columns = ideal_columns(area, n);
    return columns * std::max<std::int64_t>(1, std::llround(static_cast<double>(n) / static_cast<double>(columns)));
  }
  // The same for n = columns times rows: the divisor of n that is nearest to the ideal.
  static std::int64_t columns_of(Grid area, std::int64_t n) {
    const std::int64_t ideal = std::min(ideal_columns(area, n), n);
    for (std::int64_t away = 0;; ++away) {
      if (ideal - away >= 1 && n % (ideal - away) == 0) return ideal - away;
      if (ideal + away <= n && n % (ideal + away) == 0) return ideal + away;
    }
  }
  // x and y of the points. The grid is shifted on the torus by a random part of a cell, so that its lines are anywhere;
  // not if its jitter is 0, since such a grid is the same in every trial.
  static void fill(const Args& args, Grid area, Draw d, Points out) {
    const auto n = static_cast<std::int64_t>(out.x.size());
    const std::int64_t columns = columns_of(area, n);
    const JitteredGrid grid(static_cast<int>(columns), static_cast<int>(n / columns), args.number("amount"));
    const Key key = pixel_key(draw_hash(d.seed, d.trial), {});
    uniform_points(key, Axis::area, 0, static_cast<int>(n), out.x.data(), out.y.data());
    grid.place(out.x.data(), out.y.data());
    if (grid.amount == 0) return stretch(area, out);
    const Words w = hash(key, 0, Axis::area_order);
    const double right = unit(w.a, w.b) / grid.columns, down = unit(w.c, w.d) / grid.rows;
    for (double& x : out.x) x = wrapped(x, right);
    for (double& y : out.y) y = wrapped(y, down);
    stretch(area, out);
  }
};

}  // namespace moire
