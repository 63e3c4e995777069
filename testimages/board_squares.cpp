#include "testimages/board_squares.h"
#include "core/rounding.h"

#include <algorithm>
#include <cmath>

namespace moire {
namespace {

using Row = LocalHomography::Row;

// Bound on the rounding of a row's value at a point.
double row_error(const Row& row, Vec2 p) {
  return 6 * kUnit * (std::fabs(row.a * p.x) + std::fabs(row.b * p.y) + std::fabs(row.c.hi)) + row.c_error;
}

// Holds the range of row / W over a polygon in front of the horizon; clamped to what `low` and `high` allow.
struct Range {
  double low, high;
};
Range range(const Polygon& polygon, const Row& r, const Row& w, double low, double high) {
  Range out{HUGE_VAL, -HUGE_VAL};
  for (const Vec2 p : polygon) {
    const double W = w.a * p.x + w.b * p.y + w.c.value(), ew = row_error(w, p);
    // On the horizon (within rounding) the quotient has no bound but the board's.
    if (!(W > 4 * ew)) return {low, high};
    const double q = (r.a * p.x + r.b * p.y + r.c.value()) / W;
    if (!(std::fabs(q) < kMaxSquares)) return {low, high};
    // A vertex a little beyond a line must not be missed: what lies between would be counted in the square before it.
    const double doubt = 1.5 * (row_error(r, p) + std::fabs(q) * ew) / W + 4 * kUnit * std::fabs(q);
    out.low = std::min(out.low, q - doubt);
    out.high = std::max(out.high, q + doubt);
  }
  return {std::max(out.low, low), std::min(out.high, high)};
}

}  // namespace

void BoardCutter::cut(const Polygon& in, const Row& r, const Row& w, double k, double sign, Polygon& out) {
  const BoardLine l = board_line(r, w, k, sign);
  clip(in, l.plane, out);
  const double doubt = l.doubt(half_width_, half_width_);
  // A line that stays clear of the polygon cuts nothing and errs in nothing.
  bool clear = true;
  for (const Vec2 p : in) clear &= l.plane.at(p) > doubt;
  if (clear || in.empty()) return;
  const double size = std::hypot(l.plane.a, l.plane.b);
  // polygon.h: twice the rounding of the line's value, along its normal, plus 8 u of the window.
  const double distance = size > 0 ? 2 * doubt / size : 4 * half_width_;
  distance_ = std::max(distance_, std::min(distance, 4 * half_width_) + 8 * kUnit * half_width_);
}

BoardWindow::BoardWindow(const LocalHomography& l, const Extent& e, double h)
    : local(l), extent(e), half_width(h), cutter(h), board(square(h)) {
  Polygon next;
  const auto keep = [&](const Row& r, double k, double sign) {
    if (!std::isfinite(k)) return;
    cutter.cut(board, r, local.w, k, sign, next);
    board.swap(next);
  };
  // In front of the camera, W >= 0, written as 0 - (-1) w. A finite board is there by itself: u0 W <= U <= u1 W.
  if (!std::isfinite(extent.u0)) keep({0, 0, 0.0}, -1, 1);
  keep(local.u, extent.u0, 1);
  keep(local.u, extent.u1, -1);
  keep(local.v, extent.v0, 1);
  keep(local.v, extent.v1, -1);
}

double squares_met(const LocalHomography& local, const Polygon& polygon) {
  if (polygon.empty()) return 0;
  const auto& [u, v, w] = local;
  // On the plane, lines being lines there too: the area, and half the perimeter by way of the lines.
  double area = 0, perimeter = 0;
  Vec2 first, before;
  for (std::size_t i = 0; i <= polygon.size(); ++i) {
    const Vec2 p = polygon[i < polygon.size() ? i : 0];
    const double W = w.a * p.x + w.b * p.y + w.c.value();
    if (!(W > 4 * row_error(w, p))) return HUGE_VAL;
    const Vec2 q{(u.a * p.x + u.b * p.y + u.c.value()) / W, (v.a * p.x + v.b * p.y + v.c.value()) / W};
    if (i == 0) first = before = q;
    area += 0.5 * ((before.x - first.x) * (q.y - first.y) - (q.x - first.x) * (before.y - first.y));
    perimeter += std::fabs(q.x - before.x) + std::fabs(q.y - before.y);
    before = q;
  }
  return std::fabs(area) + 0.5 * perimeter;
}

namespace {

// The largest part of a polygon that W >= some constant leaves with at most so many squares; that constant.
double front_of(const LocalHomography& local, const Polygon& polygon, double squares) {
  const Row& w = local.w;
  double low = 0, high = 0;
  for (const Vec2 p : polygon) high = std::max(high, w.a * p.x + w.b * p.y + w.c.value());
  Polygon front;
  for (int step = 0; step < 30; ++step) {  // to 1e-9 of the window
    const double mid = 0.5 * (low + high);
    clip(polygon, {w.a, w.b, w.c.value() - mid}, front);
    (squares_met(local, front) <= squares ? high : low) = mid;
  }
  return high;
}

}  // namespace

void append_squares(BoardWindow& window, Boundary& out) {
  const auto& [u, v, w] = window.local;
  const Extent& extent = window.extent;
  BoardCutter& cutter = window.cutter;
  double error = 0;  // of areas, square pixels
  // What is not resolved counts as half covered.
  const auto unresolved = [&](const Polygon& part) {
    double area = 0;
    for (std::size_t i = 0; i < part.size(); ++i) {
      const Vec2 a = part[i], b = part[i + 1 < part.size() ? i + 1 : 0];
      out.segments.push_back({a, b, 0.5});
      area += 0.5 * (a.x * b.y - b.x * a.y);
    }
    error += 0.5 * std::fabs(area) * (1 + 0x1p-40) + cutter.slack();
  };

  Polygon strip, rest = window.board, cell, above, next;
  if (!(squares_met(window.local, rest) <= kMaxCells)) {
    const double nearest = front_of(window.local, rest, kMaxCellsOfMore);
    const Row beyond{w.a, w.b, w.c - Dd(nearest), w.c_error};
    cutter.cut(window.board, beyond, w, 0, -1, rest);
    unresolved(rest);
    cutter.cut(window.board, beyond, w, 0, 1, rest);
  }
  const Range rows = range(rest, v, w, extent.v0, extent.v1);
  if (!rest.empty()) {
    const double first = std::floor(rows.low), last = std::floor(rows.high);
    if (!(last - first < kMaxCells)) {
      unresolved(rest);
    } else {
      int cells = 0;
      for (double l = first; l <= last && !rest.empty(); ++l) {
        // Below line l + 1, and what remains above it.
        cutter.cut(rest, v, w, l + 1, -1, strip);
        cutter.cut(rest, v, w, l + 1, 1, above);
        if (!strip.empty()) {
          const Range columns = range(strip, u, w, extent.u0, extent.u1);
          const double left = std::floor(columns.low), right = std::floor(columns.high);
          if (!(right - left < kMaxCells - cells)) {
            unresolved(strip);
          } else {
            cells += static_cast<int>(right - left) + 1;
            for (double k = left; k <= right; ++k) {
              if (!even_square(k, l)) continue;
              cutter.cut(strip, u, w, k, 1, next);
              cutter.cut(next, u, w, k + 1, -1, cell);
              for (std::size_t i = 0; i < cell.size(); ++i) {
                out.segments.push_back({cell[i], cell[i + 1 < cell.size() ? i + 1 : 0]});
              }
              error += 2 * cutter.distance() * (perimeter(cell) + 8 * cutter.distance());
            }
            // Slivers that were lost between squares: at most the neighbourhood of the strip's sides.
            error += 2 * cutter.distance() * perimeter(strip);
          }
        } else {
          error += cutter.slack();
        }
        rest.swap(above);
      }
    }
  }
  // And those of the board's own sides.
  out.area_error += error + window.board_error();
}

}  // namespace moire
