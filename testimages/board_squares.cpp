#include "testimages/board_squares.h"
#include "core/rounding.h"

#include <algorithm>
#include <cmath>

namespace moire {
namespace {

using Row = LocalHomography::Row;

// The clipper's slots after the window's own. Rows and columns of squares take turns with two each: no polygon in use
// has more of them for sides.
enum Slot { kExtent = SharpClipper::kWindow, kBeyond = kExtent + 4, kRow, kColumn = kRow + 2 };
static_assert(kColumn + 2 <= SharpClipper::kSlots);

// Bound on the rounding of a row's value at a point, and of the point.
double row_error(const Row& row, Vec2 p) {
  return 6 * kUnit * (std::fabs(row.a * p.x) + std::fabs(row.b * p.y) + std::fabs(row.c.hi)) + row.c_error;
}

// Holds the range of row / W over a polygon in front of the horizon; clamped to what `low` and `high` allow.
struct Range {
  double low, high;
};
Range range(const SharpPolygon& polygon, const Row& r, const Row& w, double low, double high) {
  Range out{HUGE_VAL, -HUGE_VAL};
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 p = polygon.at(i);
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

BoardWindow::BoardWindow(const LocalHomography& l, const Extent& e, double h)
    : local(l), extent(e), half_width(h), clipper(h), part(clipper.window()) {
  SharpPolygon next;
  int slot = kExtent;
  const auto keep = [&](const Row& r, double k, double sign) {
    if (!std::isfinite(k)) return;
    clipper.set_line(slot, sharp_line(r, local.w, k, sign));
    clipper.split(part, slot++, &next, nullptr);
    std::swap(part, next);
  };
  // In front of the camera, W >= 0, written as 0 - (-1) w. A finite board is there by itself: u0 W <= U <= u1 W.
  if (!std::isfinite(extent.u0)) keep({0, 0, 0.0}, -1, 1);
  keep(local.u, extent.u0, 1);
  keep(local.u, extent.u1, -1);
  keep(local.v, extent.v0, 1);
  keep(local.v, extent.v1, -1);
  for (std::size_t i = 0; i < part.size(); ++i) board.push_back(part.at(i));
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
  SharpClipper& clipper = window.clipper;
  double error = 0;  // of areas, square pixels
  // What is not resolved counts as half covered.
  const auto unresolved = [&](const SharpPolygon& part) {
    SharpClipper::append(part, 0.5, out);
    double area = 0;
    for (std::size_t i = 0; i < part.size(); ++i) {
      const Vec2 a = part.at(i), b = part.next(i);
      area += 0.5 * (a.x * b.y - b.x * a.y);
    }
    error += 0.5 * std::fabs(area) * (1 + 0x1p-40) + 12 * kUnit * window.half_width * window.half_width;
  };

  SharpPolygon rest = window.part, strip, above, cell, right_of;
  if (!(squares_met(window.local, window.board) <= kMaxCells)) {
    const double nearest = front_of(window.local, window.board, kMaxCellsOfMore);
    clipper.set_line(kBeyond, sharp_line({w.a, w.b, w.c - Dd(nearest), w.c_error}, w, 0, 1));
    clipper.split(window.part, kBeyond, &rest, &strip);
    unresolved(strip);
  }
  const Range rows = range(rest, v, w, extent.v0, extent.v1);
  const double first = std::floor(rows.low), last = std::floor(rows.high);
  if (!(last - first < kMaxCells)) {
    if (!rest.empty()) unresolved(rest);
    rest.clear();
  }
  int cells = 0, turn = 0;
  for (double l = first; l <= last && !rest.empty(); ++l) {
    // Below line l + 1, and what remains above it; above the last row nothing does.
    if (l < last) {
      const int slot = kRow + (turn ^= 1);
      clipper.set_line(slot, sharp_line(v, w, l + 1, 1));
      clipper.split(rest, slot, &above, &strip);
    } else {
      strip = rest;
      above.clear();
    }
    std::swap(rest, above);
    if (strip.empty()) continue;
    const Range columns = range(strip, u, w, extent.u0, extent.u1);
    const double left = std::floor(columns.low), right = std::floor(columns.high);
    if (!(right - left < kMaxCells - cells)) {
      unresolved(strip);
      continue;
    }
    cells += static_cast<int>(right - left) + 1;
    int column_turn = 0;
    for (double k = left; k <= right && !strip.empty(); ++k) {
      if (k < right) {
        const int slot = kColumn + (column_turn ^= 1);
        clipper.set_line(slot, sharp_line(u, w, k + 1, 1));
        clipper.split(strip, slot, &right_of, &cell);
      } else {
        cell = strip;
        right_of.clear();
      }
      if (even_square(k, l)) SharpClipper::append(cell, 1, out);
      std::swap(strip, right_of);
    }
  }
  out.area_error += error + clipper.area_error();
}

}  // namespace moire
