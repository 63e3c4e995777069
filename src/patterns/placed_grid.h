// A grid of points as it comes to lie in a pixel: in its place, shifted on the torus, or with scrambled digits; and the
// points of some of its cells, counted or written as cells.h and HasCells (pattern.h) ask.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <span>

#include "patterns/cells.h"
#include "patterns/pattern.h"
#include "patterns/point_grid.h"
#include "patterns/torus.h"

namespace moire {

// v in [0, 1), a multiple of 2^-52, with its 52 binary digits exclusive-or'ed with others.
inline double scrambled(double v, std::uint64_t digits) noexcept {
  return std::bit_cast<double>(std::bit_cast<std::uint64_t>(1.0 + v) ^ digits) - 1.0;
}

// In its place.
inline CellPoints take_cells_of(const PointGrid& grid, std::span<const CellSpan> counted,
                                std::span<const CellSpan> filled, Points out) noexcept {
  CellPoints points;
  for (const CellSpan& span : counted) points.counted += grid.count(span.row, span.begin, span.end);
  for (const CellSpan& span : filled) {
    for (const Vec2& p : grid.points(span.row, span.begin, span.end)) {
      out.x[points.filled] = p.x;
      out.y[points.filled++] = p.y;
    }
  }
  return points;
}

// Points of a pixel from which cells of fixed sets are faster than testing all: see HasCells (pattern.h). Their points
// cost next to nothing to make, and with AVX-512 256 of them take 200 ns on an edge and 250 on a disk where all are
// tested, 370 and 510 by cells; 1024 take 600 and 700, and 600 and 680; 4096 take 3400 and 3600, and 810 and 1230.
// Shifted and scrambled ones meet at the same count, with twice those times (tests/bench/box_count.cpp).
inline constexpr int kLeastPlacedCells = 1024;

// Shifted by x and y in [0, 1), multiples of 2^-52; the grid must outlive it.
class ShiftedGrid {
 public:
  ShiftedGrid(const PointGrid& grid, double x, double y) noexcept : grid_(grid), x_(x, grid), y_(y, grid) {}

  // A shift that leaves the lines of cells within 2^-20 cells of where they were is not told apart from what rounding
  // does at the seam: then there are none.
  CellGrid cells() const noexcept {
    if (x_.near_line() || y_.near_line()) return {};
    return {grid_.side(), grid_.side(), 1 - x_.part, 1 - y_.part};
  }

  // Precondition: cells() has some.
  CellPoints take(std::span<const CellSpan> counted, std::span<const CellSpan> filled, Points out) const noexcept {
    CellPoints points;
    for (const CellSpan& span : counted) {
      for_plain(span, [&](int row, int begin, int end) { points.counted += grid_.count(row, begin, end); });
    }
    for (const CellSpan& span : filled) {
      for_plain(span, [&](int row, int begin, int end) {
        for (const Vec2& p : grid_.points(row, begin, end)) {
          out.x[points.filled] = wrapped(p.x, x_.by);
          out.y[points.filled++] = wrapped(p.y, y_.by);
        }
      });
    }
    return points;
  }

 private:
  // In cells: `whole` of them and a part; exact, as products with a power of two are.
  struct AxisShift {
    AxisShift(double shift, const PointGrid& grid) noexcept
        : by(shift), whole(static_cast<int>(shift * grid.side())), part(shift * grid.side() - whole) {}
    bool near_line() const noexcept { return part < 0x1p-20 || part > 1 - 0x1p-20; }
    double by;  // of the square
    int whole;
    double part;
  };

  // Calls f(row, begin, end) for the plain cells of a span, twice where the seam of the torus parts them. Cell i of the
  // pixel begins (i - 1 + part) / side from its corner: plain cell i - 1 - whole.
  template <class F>
  void for_plain(const CellSpan& span, F&& f) const noexcept {
    const int side = grid_.side(), last = side - 1;
    const int row = (span.row - 1 - y_.whole) & last, begin = (span.begin - 1 - x_.whole) & last,
              end = begin + (span.end - span.begin);
    f(row, begin, std::min(end, side));
    if (end > side) f(row, 0, end - side);
  }

  const PointGrid& grid_;
  AxisShift x_, y_;
};

// Scrambled by the digits x and y, below 2^52; the points must be multiples of 2^-52. The leading digits move cells as
// wholes, by an exclusive or of their numbers, so that the cells of the pixel are those of the grid.
class ScrambledGrid {
 public:
  ScrambledGrid(const PointGrid& grid, std::uint64_t x, std::uint64_t y) noexcept
      : grid_(grid),
        x_(x),
        y_(y),
        column_(static_cast<int>(x >> (52 - grid.digits()))),
        row_(static_cast<int>(y >> (52 - grid.digits()))) {}

  CellPoints take(std::span<const CellSpan> counted, std::span<const CellSpan> filled, Points out) const noexcept {
    CellPoints points;
    for (const CellSpan& span : counted) {
      points.counted += count_before(span.row ^ row_, span.end) - count_before(span.row ^ row_, span.begin);
    }
    for (const CellSpan& span : filled) {
      for (int i = span.begin; i < span.end; ++i) {
        for (const Vec2& p : grid_.points(span.row ^ row_, i ^ column_, (i ^ column_) + 1)) {
          out.x[points.filled] = scrambled(p.x, x_);
          out.y[points.filled++] = scrambled(p.y, y_);
        }
      }
    }
    return points;
  }

 private:
  // Points of the pixel's cells 0 .. end - 1 of a row: each binary digit of `end` is a block of cells that stays whole.
  std::int64_t count_before(int row, int end) const noexcept {
    std::int64_t count = 0;
    for (int left = end; left > 0; left &= left - 1) {
      const int block = left & -left, begin = ((left - block) ^ column_) & -block;
      count += grid_.count(row, begin, begin + block);
    }
    return count;
  }

  const PointGrid& grid_;
  std::uint64_t x_, y_;
  int column_, row_;
};

}  // namespace moire
