// A window as a polygon in plain doubles that lines end on: those of a checkerboard, see board_box.cpp, where the
// errors are counted, too. The rim of the board cuts it: Sutherland and Hodgman, "Reentrant polygon clipping", CACM
// 17(1), 1974.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>

#include "core/geometry.h"

namespace moire {

// The line a x + b y + c = 0, and what it is to a window; not set to 0 when it is made, like the next one.
struct PlainLine {
  double a, b, c;
  double norm;          // |a| + |b|
  double coefficients;  // bound on the error of values in the window by that of a, b and c
  int end[2];           // its ends, numbered along the outline
  unsigned crossed;     // bit i: by line i of the other family
  double at(Vec2 p) const { return a * p.x + b * p.y + c; }
};

// A Vec2 that is not set to 0 when it is made: arrays are made for every pixel and mostly not used.
struct PlainPoint {
  double x, y;
  PlainPoint() = default;
  PlainPoint(Vec2 v) : x(v.x), y(v.y) {}
  operator Vec2() const { return {x, y}; }
};

// The end of a line on the outline.
struct LineEnd {
  PlainPoint at;
  double along;  // grows on the side
  int side;
  int line;  // its number
};

// A convex polygon inside the window, in order: the closed integral of x dy is positive. No vertices: nothing.
class Outline {
 public:
  explicit Outline(double h) : size_(4) {
    const Vec2 corners[] = {{-h, -h}, {h, -h}, {h, h}, {-h, h}};
    for (std::size_t i = 0; i < 4; ++i) {
      vertex_[i] = corners[i];
      kind_[i] = i % 2 == 0 ? Kind::level : Kind::upright;
    }
  }

  std::size_t size() const { return size_; }
  Vec2 operator[](std::size_t i) const { return vertex_[i < size_ ? i : 0]; }

  // Where the line meets side i, `from` and `to` its values at the side's ends, of different sign.
  LineEnd meet(std::size_t i, const PlainLine& l, double from, double to) const {
    const Vec2 p = vertex_[i], q = (*this)[i + 1];
    LineEnd end{p, 0, static_cast<int>(i), 0};
    switch (kind_[i]) {
      case Kind::level:
        end.at.x = std::clamp(-(l.b * p.y + l.c) / l.a, std::min(p.x, q.x), std::max(p.x, q.x));
        end.along = q.x > p.x ? end.at.x : -end.at.x;
        break;
      case Kind::upright:
        end.at.y = std::clamp(-(l.a * p.x + l.c) / l.b, std::min(p.y, q.y), std::max(p.y, q.y));
        end.along = q.y > p.y ? end.at.y : -end.at.y;
        break;
      case Kind::slanted: {
        end.at = between(p, q, from, to);
        end.along = from / (from - to);
        break;
      }
    }
    return end;
  }

  // Keeps the part where the line is >= 0. Returns how long the cut is, |dx| + |dy|; nothing where the signs around the
  // outline are those of no line.
  std::optional<double> cut(const PlainLine& l) {
    std::array<PlainPoint, kCapacity> vertex;
    std::array<Kind, kCapacity> kind;
    std::size_t n = 0;
    int changes = 0;
    double length = 0;
    Vec2 before;
    double from = size_ > 0 ? l.at(vertex_[0]) : 0;
    for (std::size_t i = 0; i < size_; ++i) {
      const double to = l.at((*this)[i + 1]);
      if (from >= 0) {
        vertex[n] = vertex_[i];
        kind[n++] = kind_[i];
      }
      if ((from >= 0) != (to >= 0)) {
        const Vec2 end = meet(i, l, from, to).at;
        if (++changes == 2) length = std::fabs(end.x - before.x) + std::fabs(end.y - before.y);
        before = vertex[n] = end;
        kind[n++] = from >= 0 ? Kind::slanted : kind_[i];
      }
      from = to;
    }
    std::copy_n(vertex.begin(), n, vertex_.begin());
    std::copy_n(kind.begin(), n, kind_.begin());
    size_ = n < 3 ? 0 : n;
    if (changes > 2) return std::nullopt;
    return length;
  }

  // The zero between two points, from the one that is nearer to it.
  static Vec2 between(Vec2 p, Vec2 q, double at_p, double at_q) {
    const double d = at_p - at_q;
    const Vec2 start = std::fabs(at_p) <= std::fabs(at_q) ? p : q;
    const double t = (std::fabs(at_p) <= std::fabs(at_q) ? at_p : at_q) / d;
    return {start.x + t * (q.x - p.x), start.y + t * (q.y - p.y)};
  }

 private:
  enum class Kind : std::uint8_t { level, upright, slanted };
  // Four cuts make eight vertices; a cut by what is no line might, at once, make more.
  static constexpr std::size_t kCapacity = 12;
  std::array<PlainPoint, kCapacity> vertex_;
  std::array<Kind, kCapacity> kind_;
  std::size_t size_;
};

}  // namespace moire
