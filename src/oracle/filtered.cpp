// Iterated Gauss-Legendre quadrature of the kernel over polygons and circular caps; see filtered.h.
#include "oracle/filtered.h"

#include <algorithm>
#include <cmath>

#include "oracle/coverage.h"

namespace moire::oracle {
namespace {

struct Line {
  Point a, b;
  // Only asked between the heights of a and b, which differ.
  Quad x_at(Quad y) const { return a.x + (b.x - a.x) * ((y - a.y) / (b.y - a.y)); }
};

// A convex polygon inside the window.
Value over_polygon(const Kernel& k, const Polygon& p) {
  Quad low = p[0].y, high = p[0].y;
  for (const Point& v : p) {
    low = min(low, v.y);
    high = max(high, v.y);
  }
  std::vector<Quad> cut;
  std::vector<Line> lines;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const Line line{p[i], p[(i + 1) % p.size()]};
    cut.push_back(line.a.y);
    if (line.a.y == line.b.y) continue;
    lines.push_back(line);
    for (const long double knot : k.knots()) {
      const Quad x = widen(knot);
      if ((line.a.x < x) != (line.b.x < x))
        cut.push_back(line.a.y + (line.b.y - line.a.y) * ((x - line.a.x) / (line.b.x - line.a.x)));
    }
  }
  for (const long double knot : k.knots()) cut.push_back(widen(knot));
  std::sort(cut.begin(), cut.end());
  Value sum;
  for (std::size_t i = 0; i + 1 < cut.size(); ++i) {
    const Quad y1 = max(cut[i], low), y2 = min(cut[i + 1], high);
    if (y1 >= y2) continue;
    const Quad mid = (y1 + y2) / 2;
    const Line *left = nullptr, *right = nullptr;
    for (const Line& line : lines) {
      if ((line.a.y < mid) == (line.b.y < mid)) continue;
      if (!left || line.x_at(mid) < left->x_at(mid)) left = &line;
      if (!right || line.x_at(mid) > right->x_at(mid)) right = &line;
    }
    if (!left || left == right) continue;
    sum += integrate(
        k.line_rules(), [&](Quad y) { return k(narrow(y)) * k.over(narrow(left->x_at(y)), narrow(right->x_at(y))); },
        y1, y2);
  }
  return sum;
}

// The cap of a circle beyond s = c_s + side * flat, |t - c_t| <= wide, where s is the coordinate of the sections.
Value over_cap(const Kernel& k, const RulePair& rules, Quad c_s, Quad c_t, Quad r, Quad flat, Quad wide, int side) {
  const Quad half = widen(k.radius());
  const Quad t1 = max(-half, c_t - wide), t2 = min(half, c_t + wide);
  const Quad near = c_s + side * flat, far = c_s + side * r;
  if (t1 >= t2 || max(near, far) <= -half || min(near, far) >= half) return {};
  std::vector<Quad> cut{t1, t2};
  for (const long double knot : k.knots()) {
    cut.push_back(widen(knot));
    const Quad d = widen(knot) - c_s, reach = sqrt((r - d) * (r + d));
    cut.push_back(c_t - reach);
    cut.push_back(c_t + reach);
  }
  std::sort(cut.begin(), cut.end());
  Value sum;
  for (std::size_t i = 0; i + 1 < cut.size(); ++i) {
    const Quad a = max(cut[i], t1), b = min(cut[i + 1], t2);
    if (a >= b) continue;
    const auto section = [&](Quad t) {
      const Quad d = t - c_t, arc = c_s + side * sqrt((r - d) * (r + d));
      return k(narrow(t)) * k.over(narrow(max(min(near, arc), -half)), narrow(min(max(near, arc), half)));
    };
    sum += integrate(rules, section, a, b);
  }
  return sum;
}

// Rounding of the kernel and of the inner integrals, which integrate() does not see, over a set of at most that area in
// the window and a boundary of that length: a few long double ulps of the kernel's largest possible integral. Where
// there is less to integrate: of the product of its largest values, which are in the middle up to a third, on the area,
// and on a strip along the boundary where places are rounded, a few ulps of the radius wide.
void add_rounding(const Kernel& k, Quad area, Quad length, Value& v) {
  const long double peak = 1.5L * k(0);
  v.error += 0x1p-60L * std::min(k.gain() * k.gain(), narrow(area + widen(k.radius()) * length / 4) * peak * peak);
}

// At least the length of a polygon's sides.
Quad outline(const Polygon& p) {
  Quad sum = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const Point &a = p[i], &b = p[(i + 1) % p.size()];
    sum += abs(b.x - a.x) + abs(b.y - a.y);
  }
  return sum;
}

}  // namespace

Value filtered(const Kernel& k, const Edge& edge, Pixel pixel) { return filtered(k, around(edge, pixel)); }

Value filtered(const Kernel& k, const HalfPlane& half_plane) {
  const Polygon p = clip(half_plane, widen(k.radius()));
  if (p.size() < 3) return {};
  Value v = over_polygon(k, p);
  add_rounding(k, area(p), outline(p), v);
  return v;
}

Value filtered(const Kernel& k, const Board& board, Pixel pixel) {
  Value v;
  Quad seen = 0, lines = 0;
  for (const Polygon& p : clip(board, pixel, widen(k.radius()))) {
    v += over_polygon(k, p);
    seen += area(p);
    lines += outline(p);
  }
  add_rounding(k, seen, lines, v);
  return v;
}

Value filtered(const Kernel& k, const Disk& disk, Pixel pixel) {
  const Circle c = around(disk, pixel);
  const Quad r = c.radius, half = widen(k.radius());
  // Any flat works; the half diagonal's keeps every cap's branch points as far away as the cap is wide, times 0.4.
  const Quad flat = r * widen(0.707106781186547524L), wide = sqrt((r - flat) * (r + flat));
  const RulePair rules{Rule(16), Rule(24)};
  const auto clamped = [&](Quad a) { return narrow(max(-half, min(half, a))); };
  Value v;
  v.value = k.over(clamped(c.center.x - flat), clamped(c.center.x + flat)) *
            k.over(clamped(c.center.y - wide), clamped(c.center.y + wide));
  for (const int side : {-1, 1}) {
    v += over_cap(k, rules, c.center.x, c.center.y, r, flat, wide, side);
    v += over_cap(k, rules, c.center.y, c.center.x, r, wide, flat, side);
  }
  const Value share = coverage(c, static_cast<double>(2 * k.radius()));
  // A convex figure's boundary in the window is no longer than the window's.
  add_rounding(k, 4 * half * half * widen(share.value + share.error), min(7 * r, 8 * half), v);
  return v;
}

}  // namespace moire::oracle
