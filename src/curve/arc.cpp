#include "curve/arc.h"

#include <limits>

namespace moire {

double Arc::other(double v) const {
  if (v == v0) return other0;
  if (v == v1) return other1;
  return ArcMiddle(*this, v).other.value();
}

std::array<double, 3> Arc::passes(double at) const {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  const double r = circle.radius, gap = (at - c_other) - rest_other;
  std::array<double, 3> v{v_of(at), kNone, kNone};
  if (gap * side < 0) return v;
  if (near) {
    if (std::fabs(gap) > r) return v;
    v[1] = std::sqrt((r - gap) * (r + gap));
    v[2] = -v[1];
    return v;
  }
  // a^2 - 2 c_run a + q = 0
  const double q = at * at - 2 * c_other * at - circle.power;
  const double discriminant = c_run * c_run - q;
  if (discriminant < 0) return v;
  v[1] = c_run + std::copysign(std::sqrt(discriminant), c_run);
  if (v[1] != 0) v[2] = q / v[1];
  return v;
}

ArcMiddle::ArcMiddle(const Arc& arc, double v) : radius(arc.circle.radius), side(arc.side) {
  const Dd c_run = two_sum(arc.c_run, arc.rest_run), c_other = two_sum(arc.c_other, arc.rest_other);
  const Dd beta = arc.near ? Dd(v) : Dd(v) - c_run;
  run = arc.near ? c_run + Dd(v) : Dd(v);
  const Dd square = (Dd(radius) - beta) * (Dd(radius) + beta);
  // One step of Newton's method squares the relative error of the rounded root.
  const double s = std::sqrt(std::max(0.0, square.hi));
  const double rest = s > 0 ? (square - two_prod(s, s)).hi / (2 * s) : 0;
  other = c_other + Dd(side * s, side * rest);
  relative = beta.hi;
  offset = side * s;
}

namespace {

constexpr double kHalfRoot = 0.70710678118654752440;

// The corner between two quarters, x and y as v counts. Every quarter that ends there computes the same, so that
// neighbours meet.
Vec2 corner(const Circle& circle, bool near, bool right, bool lower) {
  const Vec2 c = circle.center, rest = circle.center_rest;
  const double leg = circle.radius * kHalfRoot;
  const double y = (near ? 0 : c.y) + (lower ? leg : -leg);
  const ArcMiddle at({circle, true, right ? 1.0 : -1.0, near, c.y, c.x, rest.y, rest.x}, y);
  return {near ? at.offset : at.other.value(), y};
}

}  // namespace

Arc quarter(const Circle& circle, Quarter which, bool near) {
  const Vec2 c = circle.center, rest = circle.center_rest;
  const Arc upright{circle, true, which == Quarter::right ? 1.0 : -1.0, near, c.y, c.x, rest.y, rest.x};
  const Arc lying{circle, false, which == Quarter::lower ? 1.0 : -1.0, near, c.x, c.y, rest.x, rest.y};
  if (which == Quarter::left || which == Quarter::right) {
    const bool right = which == Quarter::right;
    const Vec2 upper = corner(circle, near, right, false), lower = corner(circle, near, right, true);
    Arc arc = upright;
    arc.v0 = upper.y;
    arc.v1 = lower.y;
    arc.other0 = lying.run(upper.x);
    arc.other1 = lying.run(lower.x);
    return arc;
  }
  const bool lower = which == Quarter::lower;
  const Vec2 left = corner(circle, near, false, lower), right = corner(circle, near, true, lower);
  Arc arc = lying;
  arc.v0 = left.x;
  arc.v1 = right.x;
  arc.other0 = upright.run(left.y);
  arc.other1 = upright.run(right.y);
  return arc;
}

Rect around(const Circle& circle, Quarter which) {
  // 2^-40 of everything for all roundings.
  const Vec2 c = circle.center;
  const double far = circle.radius * (1 + 0x1p-40) + 0x1p-40 * (std::fabs(c.x) + std::fabs(c.y));
  const double near = circle.radius * (kHalfRoot - 0x1p-40) - 0x1p-40 * (std::fabs(c.x) + std::fabs(c.y));
  const double leg = circle.radius * (kHalfRoot + 0x1p-40) + 0x1p-40 * (std::fabs(c.x) + std::fabs(c.y));
  switch (which) {
    case Quarter::left:
      return {{c.x - far, c.y - leg}, {c.x - near, c.y + leg}};
    case Quarter::right:
      return {{c.x + near, c.y - leg}, {c.x + far, c.y + leg}};
    case Quarter::upper:
      return {{c.x - leg, c.y - far}, {c.x + leg, c.y - near}};
    case Quarter::lower:
      break;
  }
  return {{c.x - leg, c.y + near}, {c.x + leg, c.y + far}};
}

}  // namespace moire
