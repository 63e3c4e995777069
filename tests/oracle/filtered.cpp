// Iterated Gauss-Legendre quadrature of the kernel over polygons and circular caps; see filtered.h.
#include "oracle/filtered.h"

#include <algorithm>

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

// Rounding of the kernel and of the inner integrals, which integrate() does not see: a few long double ulps of the
// kernel's largest possible integral.
void add_kernel_rounding(const Kernel& k, Value& v) { v.error += 0x1p-60L * k.gain() * k.gain(); }

}  // namespace

Value filtered(const Kernel& k, const Edge& edge, Pixel pixel) {
  const Polygon p = clip(around(edge, pixel), widen(k.radius()));
  Value v;
  if (p.size() >= 3) v = over_polygon(k, p);
  add_kernel_rounding(k, v);
  return v;
}

Value filtered(const Kernel& k, const Board& board, Pixel pixel) {
  Value v;
  for (const Polygon& p : clip(board, pixel, widen(k.radius()))) v += over_polygon(k, p);
  add_kernel_rounding(k, v);
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
  add_kernel_rounding(k, v);
  return v;
}

}  // namespace moire::oracle
