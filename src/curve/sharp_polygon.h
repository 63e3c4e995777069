// Convex polygons cut by lines in more than double precision, so that every vertex is right to its last bit: Sutherland
// and Hodgman, "Reentrant polygon clipping", CACM 17(1), 1974, with vertices as meets of two lines.
//
// A new vertex is found in doubles and then corrected by the residuals of its two lines, which are formed without
// error that matters (Newton's method on two linear equations). A vertex within rounding of a cutting line is decided
// in double-double. Nothing is lost to cancellation: what remains is below 2^-66 of the window.
#pragma once

#include <array>
#include <cstddef>

#include "core/double_double.h"
#include "curve/boundary.h"

namespace moire {

// The half-plane a x + b y + c >= 0, pixels; a and b right to 2^-100 of themselves, c to `error`.
struct SharpLine {
  Dd a, b, c;
  double error = 0;
};

// A vertex is at + rest, the second the rounding error of the first. `side` is the slot of the line of the polygon's
// side that begins here.
struct SharpVertex {
  Vec2 at, rest;
  int side;
};

// Vertices in order; none: nothing. Each cut of a convex polygon adds at most one vertex.
class SharpPolygon {
 public:
  SharpPolygon() = default;
  SharpPolygon(const SharpPolygon& other) { *this = other; }
  SharpPolygon& operator=(const SharpPolygon& other);

  void clear() { size_ = 0; }
  void push_back(const SharpVertex& v);
  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  SharpVertex operator[](std::size_t i) const {
    const Stored& v = stored_[i];
    return {{v.x, v.y}, {v.rest_x, v.rest_y}, v.side};
  }
  Vec2 at(std::size_t i) const { return {stored_[i].x, stored_[i].y}; }
  // The vertex after vertex i.
  Vec2 next(std::size_t i) const { return at(i + 1 < size_ ? i + 1 : 0); }

  static constexpr std::size_t kCapacity = 24;

 private:
  // Not initialized, and copied only as far as they are used: polygons are made and dropped for every pixel.
  struct Stored {
    double x, y, rest_x, rest_y;
    int side;
  };
  std::array<Stored, kCapacity> stored_;
  std::size_t size_ = 0;
};

// Cuts polygons inside a window, a square [-half_width, half_width]^2 or any rectangle, by lines. A polygon's sides
// name their lines by slot: a slot may be given another line once no polygon in use has a side there.
class SharpClipper {
 public:
  static constexpr int kWindow = 4;  // the window's sides have the slots below
  static constexpr int kSlots = 16;

  explicit SharpClipper(double half_width);
  explicit SharpClipper(const Rect& window);

  // The window, oriented so that the closed integral of x dy is positive.
  SharpPolygon window() const;
  // kWindow <= slot < kSlots. A line without direction (a = b = 0) is a sign that holds everywhere.
  void set_line(int slot, const SharpLine& line);
  // The parts of `in` where the line is >= 0 and <= 0; either may be null. `in` is neither of them.
  void split(const SharpPolygon& in, int slot, SharpPolygon* front, SharpPolygon* back);
  // Bound on the area, square pixels, that all cuts so far have put on the wrong side of their true lines, the
  // rounding of vertices to doubles left out.
  double area_error() const { return area_error_; }

  // Appends the polygon's sides; those that are not the window's own are in doubt by the rounding of their ends.
  static void append(const SharpPolygon& polygon, double weight, Boundary& out);

 private:
  // No default values: the array below is made for every pixel and mostly not used.
  struct Line {
    double a, b, c, a_rest, b_rest, c_rest;
    double error, norm;  // |a| + |b|
    Dd exactly(const SharpVertex& v) const;
    double residual(Vec2 p) const;
  };
  SharpVertex meet(const SharpVertex& a, double value_a, const SharpVertex& b, double value_b, const Line& line) const;

  Rect window_;
  double half_width_, area_error_ = 0;  // of the square around the origin that holds the window
  std::array<Line, kSlots> lines_;
};

}  // namespace moire
