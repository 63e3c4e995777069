// The board of dart-throwing: kept points on the unit torus, and the question whether a candidate is too near to one.
//
// Two grids answer it. Boxes, about 8 to a radius, know the distance within which one kept point covers them whole:
// most misses are seen there with one comparison. Cells, at least as wide as the first radius, list their points:
// whoever is nearer than r lies in the same or an adjacent cell. Neither changes an answer; they are there for speed.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>

namespace moire {

class DartBoard {
 public:
  // Working memory of a board for n points whose radius starts at r0 and never grows. Not initialised, so that it
  // costs nothing before it is used; at most 4 MiB + 8 bytes per point.
  class Memory {
   public:
    Memory(int n, double r0)
        : cells_(cells_per_side(r0)),
          boxes_(boxes_per_side(r0)),
          first_(std::make_unique_for_overwrite<std::int32_t[]>(square(cells_))),
          next_(std::make_unique_for_overwrite<std::int32_t[]>(static_cast<std::size_t>(n))),
          reach2_(std::make_unique_for_overwrite<float[]>(square(boxes_))) {}

   private:
    friend class DartBoard;
    int cells_, boxes_;  // per side
    std::unique_ptr<std::int32_t[]> first_, next_;
    std::unique_ptr<float[]> reach2_;
  };

  // An empty board. The points are kept in x and y, n numbers each.
  DartBoard(Memory& memory, double* x, double* y) noexcept
      : cells_(memory.cells_),
        boxes_(memory.boxes_),
        first_(memory.first_.get()),
        next_(memory.next_.get()),
        reach2_(memory.reach2_.get()),
        x_(x),
        y_(y) {
    std::fill_n(first_, square(cells_), -1);
    std::fill_n(reach2_, square(boxes_), 4.0f);  // more than any distance on the torus
  }

  int kept() const noexcept { return kept_; }

  // Whether a kept point is nearer to (x, y) than r: toroidal distance^2 < r * r, as computed.
  bool too_near(double x, double y, double r) const noexcept {
    const double r2 = r * r;
    if (static_cast<double>(reach2_[at(x, boxes_) + boxes_ * at(y, boxes_)]) < r2) return true;
    const int column = at(x, cells_), row = at(y, cells_);
    if (cells_ == 1) return near_in(0, x, y, r2);
    for (const int j : {row, wrapped(row - 1, cells_), wrapped(row + 1, cells_)})
      for (const int i : {column, wrapped(column - 1, cells_), wrapped(column + 1, cells_)})
        if (near_in(i + cells_ * j, x, y, r2)) return true;
    return false;
  }

  // Adds a point; later questions must not ask for more than r.
  void keep(double x, double y, double r) noexcept {
    x_[kept_] = x;
    y_[kept_] = y;
    std::int32_t& first = first_[at(x, cells_) + cells_ * at(y, cells_)];
    next_[kept_] = first;
    first = kept_++;
    cover(x, y, r);
  }

 private:
  static std::size_t square(int side) noexcept {
    return static_cast<std::size_t>(side) * static_cast<std::size_t>(side);
  }
  // Slightly wider than r0, since a point on a cell's side may be put on either side of it by rounding. Fewer than 3
  // cells to a side would make a neighbour appear twice: then all points share one cell.
  static int cells_per_side(double r0) noexcept {
    const int side = static_cast<int>((1 - 0x1p-20) / r0);
    return side < 3 ? 1 : side;
  }
  static int boxes_per_side(double r0) noexcept { return std::clamp(static_cast<int>(8 / r0), 1, 1024); }

  static int at(double x, int side) noexcept { return static_cast<int>(x * side); }
  static int wrapped(int i, int side) noexcept { return i < 0 ? i + side : i >= side ? i - side : i; }

  bool near_in(int cell, double x, double y, double r2) const noexcept {
    for (std::int32_t i = first_[cell]; i >= 0; i = next_[i]) {
      double dx = std::abs(x_[i] - x), dy = std::abs(y_[i] - y);
      dx = std::min(dx, 1 - dx);
      dy = std::min(dy, 1 - dy);
      if (dx * dx + dy * dy < r2) return true;
    }
    return false;
  }

  // Tells the boxes around a new point how far it is from their farthest corner. 2^-20 more than that, relative, stands
  // above all rounding here, in near_in() and in finding a candidate's box.
  void cover(double x, double y, double r) noexcept {
    const int reach = std::min(static_cast<int>(r * boxes_), (boxes_ - 1) / 2);
    const int column = at(x, boxes_), row = at(y, boxes_);
    for (int j = row - reach; j <= row + reach; ++j) {
      const double dy = to_far_side(y, j);
      float* const boxes = reach2_ + boxes_ * wrapped(j, boxes_);
      for (int i = column - reach; i <= column + reach; ++i) {
        const double dx = to_far_side(x, i);
        float& reach2 = boxes[wrapped(i, boxes_)];
        reach2 = std::min(reach2, static_cast<float>((dx * dx + dy * dy) * (1 + 0x1p-20)));
      }
    }
  }
  // Distance from x to the far side of box column i, which may lie beyond the ends of [0, 1).
  double to_far_side(double x, int i) const noexcept {
    return std::max(std::abs(x - static_cast<double>(i) / boxes_), std::abs(x - (i + 1.0) / boxes_));
  }

  int cells_, boxes_;            // per side
  std::int32_t *first_, *next_;  // the first point of each cell and the one after each point, or -1
  float* reach2_;                // per box: a candidate anywhere in it is nearer than sqrt(reach2) to a kept point
  double *x_, *y_;
  std::int32_t kept_ = 0;
};

}  // namespace moire
