#include "testimages/board_squares.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/rounding.h"
#include "testimages/board_side.h"
#include "testimages/half_covered.h"

namespace moire {
namespace {

using Row = LocalHomography::Row;

// The clipper's slots after the window's own. Rows and columns of squares take turns with two each: no polygon in use
// has more of them for sides.
enum Slot {
  kExtent = SharpClipper::kWindow,
  kBeyond = BoardWindow::kCut,
  kRow,
  kColumn = kRow + 2,
  kMiddle = kColumn + 2
};
static_assert(kMiddle + 2 <= SharpClipper::kSlots);

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
    : BoardWindow(l, e, Rect{{-h, -h}, {h, h}}) {}

BoardWindow::BoardWindow(const LocalHomography& l, const Extent& e, const Rect& window)
    : local(l),
      extent(e),
      half_width(std::max(std::max(-window.lo.x, window.hi.x), std::max(-window.lo.y, window.hi.y))),
      clipper(window),
      part(clipper.window()) {
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

double largest_w(const LocalHomography& local, const Polygon& polygon) {
  double largest = 0;
  for (const Vec2 p : polygon) largest = std::max(largest, row_at(local.w, p).value());
  return largest;
}

Polygon rounded(const SharpPolygon& part) {
  Polygon polygon;
  for (std::size_t i = 0; i < part.size(); ++i) polygon.push_back(part.at(i));
  return polygon;
}

double squares_before(const LocalHomography& local, const Polygon& polygon, double depth) {
  Polygon front;
  clip(polygon, {local.w.a, local.w.b, local.w.c.value() - depth}, front);
  return squares_met(local, front);
}

double depth_with(const LocalHomography& local, const Polygon& polygon, double depth, double deepest, double squares) {
  if (squares_before(local, polygon, depth) <= squares) return depth;
  double low = depth, high = deepest;
  for (int step = 0; step < 24; ++step) {
    const double mid = 0.5 * (low + high);
    (squares_before(local, polygon, mid) <= squares ? high : low) = mid;
  }
  return high;
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

// The window's part that is cut into squares where it has too many, and the rest.
struct Split {
  SharpPolygon front, behind;
  Unresolved rest;
};

// Cut with about so many squares in front, at W = constant, or along a middle line of squares near there, which makes
// the bound on the rest one of second order: whichever is best for a smooth weight.
Split split(BoardWindow& window, double squares) {
  const auto& [u, v, w] = window.local;
  SharpClipper& clipper = window.clipper;
  const auto depth_at = [&w = w](Vec2 p) { return w.a * p.x + w.b * p.y + w.c.value(); };
  const double nearest = front_of(window.local, window.board, squares);
  Split best;
  clipper.set_line(kBeyond, sharp_line({w.a, w.b, w.c - Dd(nearest), w.c_error}, w, 0, 1));
  clipper.split(window.part, kBeyond, &best.front, &best.behind);
  best.rest = half_covered(window.local, best.behind);
  const double h = window.half_width;
  const WeightBounds typical{1, 0, 0, 1 / h, 1 / h, 4 / (h * h), 1 / h};
  Vec2 mid, deepest = window.board.front();
  bool cut = false;
  for (std::size_t i = 0; i < best.behind.size(); ++i) {
    if (best.behind[i].side != kBeyond) continue;
    const Vec2 a = best.behind.at(i), b = best.behind.next(i);
    mid = {0.5 * (a.x + b.x), 0.5 * (a.y + b.y)};
    cut = depth_at(mid) > 0;
  }
  for (const Vec2 p : window.board) deepest = depth_at(p) > depth_at(deepest) ? p : deepest;
  for (const bool of_u : {true, false}) {
    const Row& row = of_u ? u : v;
    const auto at = [&](Vec2 p) { return (row.a * p.x + row.b * p.y + row.c.value()) / depth_at(p); };
    if (!cut || !(std::fabs(at(mid)) < kMaxSquares / 4)) continue;
    const MiddleLine middle{kMiddle + of_u, of_u, std::floor(at(mid)) + 0.5};
    clipper.set_line(middle.slot, sharp_line(row, w, middle.at, at(deepest) > middle.at ? 1 : -1));
    Split other;
    clipper.split(window.part, middle.slot, &other.front, &other.behind);
    Polygon front;
    for (std::size_t i = 0; i < other.front.size(); ++i) front.push_back(other.front.at(i));
    if (!(squares_met(window.local, front) <= 1.5 * squares)) continue;
    other.rest = half_covered(window.local, other.behind, middle);
    if (other.rest.bound(typical) < best.rest.bound(typical)) best = other;
  }
  return best;
}

// Where to cut; nothing: nowhere, all squares are clipped.
std::optional<Split> usual_split(BoardWindow& window) {
  if (squares_met(window.local, window.board) <= kMaxCells) return std::nullopt;
  return split(window, kMaxCellsOfMore);
}

// From one try to the next: that makes the bound on a weight without jumps some two to eight times smaller.
constexpr double kMore = 4;

std::optional<Split> split_for(BoardWindow& window, const SquaresAim& aim) {
  const double all = squares_met(window.local, window.board);
  const auto enough = [&](const Split& parts) { return parts.rest.bound(aim.weight) <= aim.goal; };
  for (double squares = aim.least; squares < std::min<double>(all, kMaxCellsOfMore); squares *= kMore) {
    Split parts = split(window, squares);
    if (enough(parts)) return parts;
  }
  std::optional<Split> parts = usual_split(window);
  for (double squares = kMaxCellsOfMore; parts && squares < aim.most && !enough(*parts);) {
    squares = std::min(kMore * squares, aim.most);
    parts = split(window, squares);
  }
  return parts;
}

void append(BoardWindow& window, const std::optional<Split>& parts, double most, Boundary& out) {
  const auto& [u, v, w] = window.local;
  const Extent& extent = window.extent;
  SharpClipper& clipper = window.clipper;
  const auto append_half = [&](const SharpPolygon& part, const Unresolved& unresolved) {
    SharpClipper::append(part, 0.5, out);
    out.unresolved.push_back(unresolved);
    out.area_error += 12 * kUnit * window.half_width * window.half_width;
  };
  const auto unresolved = [&](const SharpPolygon& part) { append_half(part, half_covered(window.local, part)); };

  SharpPolygon rest = window.part, strip, above, cell, right_of;
  if (parts) {
    append_half(parts->behind, parts->rest);
    rest = parts->front;
  }
  const Range rows = range(rest, v, w, extent.v0, extent.v1);
  const double first = std::floor(rows.low), last = std::floor(rows.high);
  if (!(last - first < most)) {
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
    if (!(right - left < most - cells)) {
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
  out.area_error += clipper.area_error();
}

}  // namespace

void append_squares(BoardWindow& window, Boundary& out) { append(window, usual_split(window), kMaxCells, out); }

void append_squares(BoardWindow& window, const SquaresAim& aim, Boundary& out) {
  // A split may have half as many squares more than it was asked for.
  append(window, split_for(window, aim), std::max<double>(kMaxCells, 2 * aim.most), out);
}

}  // namespace moire
