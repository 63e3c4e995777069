// The board of dart-throwing: kept points on a torus, and how near they are. Cells at least as wide as the first radius
// list their points, so that whoever is nearer than r lies in the same or an adjacent cell.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>

namespace moire {

class DartBoard {
 private:
  struct Side {
    double length;
    int cells;
    double cells_per_unit = 0;
    // Cells slightly wider than r0, since a point on a cell's side may be put on either side of it by rounding.
    Side(double l, double r0) : length(l), cells(std::max(1, static_cast<int>((1 - 0x1p-20) * l / r0))) {}
  };
  struct Point {
    double x, y;
    std::int32_t next;  // of the same cell, or -1
  };

 public:
  // Working memory of a board for n points on a torus of width x height whose radius starts at r0 and never grows. Not
  // initialised, so that it costs nothing before it is used: 24 bytes a point and 4 a cell, of which there are fewer.
  class Memory {
   public:
    Memory(int n, double r0, double width, double height)
        : across_(width, r0), down_(height, r0), points_(std::make_unique_for_overwrite<Point[]>(size(n))) {
      // Fewer than 3 cells to a side would make a neighbour appear twice: then all points share one cell.
      if (across_.cells < 3 || down_.cells < 3) across_.cells = down_.cells = 1;
      for (Side* side : {&across_, &down_}) side->cells_per_unit = side->cells / side->length;
      first_ = std::make_unique_for_overwrite<std::int32_t[]>(size(across_.cells) * size(down_.cells));
    }

   private:
    friend class DartBoard;
    static std::size_t size(int n) noexcept { return static_cast<std::size_t>(n); }
    Side across_, down_;
    std::unique_ptr<std::int32_t[]> first_;
    std::unique_ptr<Point[]> points_;
  };

  // An empty board.
  explicit DartBoard(Memory& memory) noexcept
      : across_(memory.across_), down_(memory.down_), first_(memory.first_.get()), points_(memory.points_.get()) {
    std::fill_n(first_, Memory::size(across_.cells) * Memory::size(down_.cells), -1);
  }

  int kept() const noexcept { return kept_; }
  double width() const noexcept { return across_.length; }
  double height() const noexcept { return down_.length; }

  // Adds a point of [0, width) x [0, height).
  void keep(double x, double y) noexcept {
    std::int32_t& first = first_[cell(x, across_) + across_.cells * cell(y, down_)];
    points_[kept_] = {x, y, first};
    first = kept_++;
  }

  // Calls use(|dx|, |dy|), differences on the torus, for kept points until it returns true, and says whether it did. No
  // point nearer to (x, y) than r0 is left out.
  template <class Use>
  [[gnu::always_inline]] bool any_near(double x, double y, const Use& use) const noexcept {
    const auto any_in = [&](int cell) {
      for (std::int32_t i = first_[cell]; i >= 0; i = points_[i].next) {
        const double dx = std::abs(points_[i].x - x), dy = std::abs(points_[i].y - y);
        if (use(std::min(dx, across_.length - dx), std::min(dy, down_.length - dy))) return true;
      }
      return false;
    };
    if (across_.cells == 1) return any_in(0);
    const int column = cell(x, across_), row = cell(y, down_);
    for (const int j : {row, wrapped(row - 1, down_.cells), wrapped(row + 1, down_.cells)})
      for (const int i : {column, wrapped(column - 1, across_.cells), wrapped(column + 1, across_.cells)})
        if (any_in(i + across_.cells * j)) return true;
    return false;
  }

  // Whether a kept point is nearer to (x, y) than r <= r0: toroidal distance^2 < r * r, as computed.
  bool too_near(double x, double y, double r) const noexcept {
    const double r2 = r * r;
    return any_near(x, y, [r2](double dx, double dy) { return dx * dx + dy * dy < r2; });
  }

 private:
  // x < length, but the product may round up to the number of cells.
  static int cell(double x, const Side& side) noexcept {
    return std::min(static_cast<int>(x * side.cells_per_unit), side.cells - 1);
  }
  static int wrapped(int i, int side) noexcept { return i < 0 ? i + side : i >= side ? i - side : i; }

  Side across_, down_;
  std::int32_t* first_;  // of each cell, or -1
  Point* points_;
  std::int32_t kept_ = 0;
};

}  // namespace moire
