// The board of dart-throwing: kept points on a torus, and the question whether a candidate is too near to one.
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
  // Working memory of a board for n points on a torus of width x height whose radius starts at r0 and never grows. Not
  // initialised, so that it costs nothing before it is used; at most 4 bytes times most_boxes^2 + 8 bytes per point.
  class Memory {
   public:
    Memory(int n, double r0, double width = 1, double height = 1, int most_boxes = 1024)
        : across_(width, r0, most_boxes),
          down_(height, r0, most_boxes),
          first_(std::make_unique_for_overwrite<std::int32_t[]>(product(across_.cells, down_.cells))),
          next_(std::make_unique_for_overwrite<std::int32_t[]>(static_cast<std::size_t>(n))),
          reach2_(std::make_unique_for_overwrite<float[]>(product(across_.boxes, down_.boxes))) {
      // Fewer than 3 cells to a side would make a neighbour appear twice: then all points share one cell.
      if (across_.cells < 3 || down_.cells < 3) across_.cells = down_.cells = 1;
      for (Side* side : {&across_, &down_}) {
        side->cells_per_unit = side->cells / side->length;
        side->boxes_per_unit = side->boxes / side->length;
      }
    }

   private:
    friend class DartBoard;
    struct Side {
      double length;
      int cells, boxes;
      double cells_per_unit = 0, boxes_per_unit = 0;
      // Cells slightly wider than r0, since a point on a cell's side may be put on either side of it by rounding.
      Side(double l, double r0, int most_boxes)
          : length(l),
            cells(std::max(1, static_cast<int>((1 - 0x1p-20) * l / r0))),
            boxes(std::clamp(static_cast<int>(8 * l / r0), 1, most_boxes)) {}
    };
    static std::size_t product(int a, int b) noexcept {
      return static_cast<std::size_t>(a) * static_cast<std::size_t>(b);
    }
    Side across_, down_;
    std::unique_ptr<std::int32_t[]> first_, next_;
    std::unique_ptr<float[]> reach2_;
  };

  // An empty board. The points are kept in x and y, n numbers each.
  DartBoard(Memory& memory, double* x, double* y) noexcept
      : across_(memory.across_),
        down_(memory.down_),
        first_(memory.first_.get()),
        next_(memory.next_.get()),
        reach2_(memory.reach2_.get()),
        x_(x),
        y_(y) {
    std::fill_n(first_, Memory::product(across_.cells, down_.cells), -1);
    const double far = across_.length * across_.length + down_.length * down_.length;
    std::fill_n(reach2_, Memory::product(across_.boxes, down_.boxes),
                static_cast<float>(2 * far));  // more than any distance on the torus
  }

  int kept() const noexcept { return kept_; }

  // Whether a kept point is nearer to (x, y) than r: toroidal distance^2 < r * r, as computed.
  bool too_near(double x, double y, double r) const noexcept {
    const double r2 = r * r;
    if (static_cast<double>(reach2_[box(x, across_) + across_.boxes * box(y, down_)]) < r2) return true;
    const int column = cell(x, across_), row = cell(y, down_);
    if (across_.cells == 1) return near_in(0, x, y, r2);
    for (const int j : {row, wrapped(row - 1, down_.cells), wrapped(row + 1, down_.cells)})
      for (const int i : {column, wrapped(column - 1, across_.cells), wrapped(column + 1, across_.cells)})
        if (near_in(i + across_.cells * j, x, y, r2)) return true;
    return false;
  }

  // Adds a point; later questions must not ask for more than r.
  void keep(double x, double y, double r) noexcept {
    x_[kept_] = x;
    y_[kept_] = y;
    std::int32_t& first = first_[cell(x, across_) + across_.cells * cell(y, down_)];
    next_[kept_] = first;
    first = kept_++;
    cover(x, y, r);
  }

 private:
  using Side = Memory::Side;

  // x < length, but the product may round up to the number of parts.
  static int cell(double x, const Side& side) noexcept {
    return std::min(static_cast<int>(x * side.cells_per_unit), side.cells - 1);
  }
  static int box(double x, const Side& side) noexcept {
    return std::min(static_cast<int>(x * side.boxes_per_unit), side.boxes - 1);
  }
  static int wrapped(int i, int side) noexcept { return i < 0 ? i + side : i >= side ? i - side : i; }

  bool near_in(int cell, double x, double y, double r2) const noexcept {
    for (std::int32_t i = first_[cell]; i >= 0; i = next_[i]) {
      double dx = std::abs(x_[i] - x), dy = std::abs(y_[i] - y);
      dx = std::min(dx, across_.length - dx);
      dy = std::min(dy, down_.length - dy);
      if (dx * dx + dy * dy < r2) return true;
    }
    return false;
  }

  // Tells the boxes around a new point how far it is from their farthest corner. 2^-20 more than that, relative, stands
  // above all rounding here, in near_in() and in finding a candidate's box.
  void cover(double x, double y, double r) noexcept {
    const int right = reach(r, across_), below = reach(r, down_);
    const int column = box(x, across_), row = box(y, down_);
    for (int j = row - below; j <= row + below; ++j) {
      const double dy = to_far_side(y, j, down_);
      float* const boxes = reach2_ + static_cast<std::ptrdiff_t>(across_.boxes) * wrapped(j, down_.boxes);
      for (int i = column - right; i <= column + right; ++i) {
        const double dx = to_far_side(x, i, across_);
        float& reach2 = boxes[wrapped(i, across_.boxes)];
        reach2 = std::min(reach2, static_cast<float>((dx * dx + dy * dy) * (1 + 0x1p-20)));
      }
    }
  }
  static int reach(double r, const Side& side) noexcept {
    return std::min(static_cast<int>(r * side.boxes_per_unit), (side.boxes - 1) / 2);
  }
  // Distance from x to the far side of box i of a side, which may lie beyond the ends of [0, length).
  static double to_far_side(double x, int i, const Side& side) noexcept {
    return std::max(std::abs(x - static_cast<double>(i) / side.boxes * side.length),
                    std::abs(x - (i + 1.0) / side.boxes * side.length));
  }

  Side across_, down_;
  std::int32_t *first_, *next_;  // the first point of each cell and the one after each point, or -1
  float* reach2_;                // per box: a candidate anywhere in it is nearer than sqrt(reach2) to a kept point
  double *x_, *y_;
  std::int32_t kept_ = 0;
};

}  // namespace moire
