// Jittered sampling: one random point in each cell of a grid. Its error falls as N^-3/4 at edges.
// R. L. Cook, "Stochastic sampling in computer graphics", ACM TOG 5(1), 1986.
#include <algorithm>
#include <cmath>

#include "patterns/area.h"
#include "patterns/pattern.h"
#include "patterns/strata.h"
#include "patterns/torus.h"
#include "patterns/uniform.h"

namespace moire {
namespace {

constexpr Param kParams[] = {
    number("amount", 1, 0, 1, "size of the jitter as a fraction of the cell; 0 is the regular grid"),
    choice(
        "cells", "square", "square|oblong",
        "square cells, n a square; or the grid of n cells in a pixel whose cells are nearest to squares, for any n")};

// A grid of random points on the unit square: cell (i % columns, i / columns) holds point i.
struct JitteredGrid {
  int columns, rows;
  double amount;
  Strata across, down;

  JitteredGrid(int columns_, int rows_, double amount_)
      : columns(columns_), rows(rows_), amount(amount_), across(columns), down(rows) {}

  // The offset in the cell after shrinking towards its middle. Rounding is monotone and the extreme offsets are
  // doubles, so the result stays between them for every amount in [0, 1].
  double jitter(const Strata& strata, double u) const noexcept { return 0.5 + amount * (strata.offset(u) - 0.5); }

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

// The largest divisor of n that is at most its root.
int rows_of(int n) {
  int rows = static_cast<int>(std::sqrt(static_cast<double>(n)));
  while (n % rows != 0) --rows;
  return rows;
}

struct Jittered {
  int n;
  JitteredGrid grid;
  std::uint64_t draw;

  Jittered(const Args& args, int count, Draw d)
      : n(count),
        grid(count / rows_of(count), rows_of(count), args.number("amount")),
        draw(draw_hash(d.seed, d.trial)) {}

  void fill(std::span<const Pixel> run, Points out) const noexcept {
    double *x = out.x.data(), *y = out.y.data();
    for (const Pixel& pixel : run) {
      uniform_points(pixel_key(draw, pixel), Axis::xy, 0, n, x, y);
      grid.place(x, y);
      x += n;
      y += n;
    }
  }

  // Columns of the grid over the area whose n cells would be square.
  static std::int64_t ideal_columns(Grid area, std::int64_t n) {
    return std::max<std::int64_t>(1, std::llround(std::sqrt(static_cast<double>(n) * area.width / area.height)));
  }
  static std::int64_t area_count(const Args&, Grid area, std::int64_t n) {
    const std::int64_t columns = ideal_columns(area, n);
    return columns * std::max<std::int64_t>(1, std::llround(static_cast<double>(n) / static_cast<double>(columns)));
  }
  // The same for n = columns times rows: the divisor of n that is nearest to the ideal.
  static std::int64_t area_columns(Grid area, std::int64_t n) {
    const std::int64_t ideal = std::min(ideal_columns(area, n), n);
    for (std::int64_t away = 0;; ++away) {
      if (ideal - away >= 1 && n % (ideal - away) == 0) return ideal - away;
      if (ideal + away <= n && n % (ideal + away) == 0) return ideal + away;
    }
  }
  // The grid is shifted on the torus by a random part of a cell, so that its lines are anywhere; not if nothing else is
  // random, since such a pattern is the same in every trial.
  static void fill_area(const Args& args, Grid area, Draw d, Points out) {
    const auto count = static_cast<std::int64_t>(out.x.size());
    const std::int64_t columns = area_columns(area, count);
    const JitteredGrid grid(static_cast<int>(columns), static_cast<int>(count / columns), args.number("amount"));
    const Key key = pixel_key(draw_hash(d.seed, d.trial), {});
    uniform_points(key, Axis::area, 0, static_cast<int>(count), out.x.data(), out.y.data());
    grid.place(out.x.data(), out.y.data());
    if (grid.amount == 0) return stretch(area, out);
    const Words w = hash(key, 0, Axis::area_order);
    const double right = unit(w.a, w.b) / grid.columns, down = unit(w.c, w.d) / grid.rows;
    for (double& x : out.x) x = wrapped(x, right);
    for (double& y : out.y) y = wrapped(y, down);
    stretch(area, out);
  }
};

PatternInfo::Counts jittered_count(const Args& args, int n) {
  return args.text("cells") == "square" ? square_count(args, n) : any_count(args, n);
}

}  // namespace

extern const PatternInfo jittered_pattern;
constinit const PatternInfo jittered_pattern = describe<Jittered>(
    {.name = "jittered",
     .title = "One random point in each cell of a grid",
     .cite = "Cook 1986",
     .varies = [](const Args& args) { return args.number("amount") > 0 ? Varies::by_trial : Varies::never; },
     .counts = jittered_count,
     .params = kParams});

}  // namespace moire
