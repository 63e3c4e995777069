// A circle seen from a pixel; see circle.h.
#include "testimages/circle.h"

#include "core/error.h"
#include "core/expansion.h"
#include "testimages/point_signs.h"
#include "testimages/scene_args.h"

namespace moire {
namespace {

// The sign of |origin + p - center - t motion|^2 - radius^2, exactly.
int exact_sign(const GivenCircle& circle, Pixel origin, Vec2 p, double t = 0, Vec2 motion = {}) noexcept {
  Expansion sum;
  const Dd ox = dd_from_integer(origin.x), oy = dd_from_integer(origin.y);
  const Dd mx = two_prod(t, motion.x), my = two_prod(t, motion.y);
  const double terms[2][6] = {{p.x, ox.hi, ox.lo, -circle.center.x, -mx.hi, -mx.lo},
                              {p.y, oy.hi, oy.lo, -circle.center.y, -my.hi, -my.lo}};
  for (const auto& of_axis : terms) {
    for (int i = 0; i < 6; ++i) {
      if (of_axis[i] == 0) continue;
      sum.add_product(of_axis[i], of_axis[i]);
      for (int j = i + 1; j < 6; ++j) sum.add_product(2 * of_axis[i], of_axis[j]);
    }
  }
  sum.add_product(-circle.radius, circle.radius);
  return sum.sign();
}
// Adds +- the exact square of a + b.
void add_square_of_sum(double a, double b, double sign, Expansion& sum) noexcept {
  const Dd s = two_sum(a, b);
  sum.add_product(sign * s.hi, s.hi);
  sum.add_product(sign * 2 * s.hi, s.lo);
  sum.add_product(sign * s.lo, s.lo);
}

}  // namespace

void require_radius(const Value& v, std::string_view name, double radius) {
  require_within(v, name, radius);
  if (!(radius >= kMinRadius)) {
    throw Error(v.place, "\"" + std::string(name) + "\" is " + shortest(radius) + "; it must be at least " +
                             shortest(kMinRadius) + " pixels");
  }
}

LocalCircle seen_from(const GivenCircle& circle, Pixel origin, double shift, Vec2 moved) noexcept {
  const Dd cx = Dd(circle.center.x) - dd_from_integer(origin.x) - Dd(shift) + Dd(moved.x);
  const Dd cy = Dd(circle.center.y) - dd_from_integer(origin.y) - Dd(shift) + Dd(moved.y);
  return {cx, cy, (two_prod(circle.radius, circle.radius) - cx * cx - cy * cy).value()};
}

void mark_inside(const GivenCircle& circle, Pixel origin, std::span<const double> x, std::span<const double> y,
                 Vec2 reach, std::span<std::uint8_t> inside) noexcept {
  const LocalCircle at = seen_from(circle, origin, 0);
  const double doubt = at.doubt(reach.x, reach.y);
  const CircleSign excess{{2 * at.cx.hi, 2 * at.cy.hi}, at.power, doubt};
  if (!sign_loops().back().mark_within(excess, x, y, inside.data())) return;
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (std::fabs(at.excess(x[i], y[i])) > doubt) continue;
    inside[i] |= static_cast<std::uint8_t>(exact_sign(circle, origin, {x[i], y[i]}) <= 0);
  }
}

void mark_inside_at(const GivenCircle& circle, Vec2 motion, Pixel origin, std::span<const double> x,
                    std::span<const double> y, std::span<const double> t, Vec2 reach,
                    std::span<std::uint8_t> inside) noexcept {
  const LocalCircle at = seen_from(circle, origin, 0);
  // The point moved back errs by 2 u reach, which changes the excess by twice that times its distance to the centre,
  // reach + |c| at most: less than the doubt of the excess itself.
  const double doubt = 2 * at.doubt(reach.x, reach.y);
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double e = at.excess(x[i] - t[i] * motion.x, y[i] - t[i] * motion.y);
    if (e > doubt) continue;
    inside[i] |= static_cast<std::uint8_t>(e < -doubt || exact_sign(circle, origin, {x[i], y[i]}, t[i], motion) <= 0);
  }
}

Cover cover(const LocalCircle& at, Rect r) noexcept {
  const double ax = std::max(std::fabs(r.lo.x), std::fabs(r.hi.x)), ay = std::max(std::fabs(r.lo.y), std::fabs(r.hi.y));
  const double doubt = at.doubt(ax, ay);
  // The excess grows with the distance to the centre: nearest point and farthest corner decide.
  const double near = at.excess(std::clamp(at.cx.hi, r.lo.x, r.hi.x), std::clamp(at.cy.hi, r.lo.y, r.hi.y));
  if (near > doubt) return Cover::none;
  const double far = at.excess(at.cx.hi - r.lo.x > r.hi.x - at.cx.hi ? r.lo.x : r.hi.x,
                               at.cy.hi - r.lo.y > r.hi.y - at.cy.hi ? r.lo.y : r.hi.y);
  return far < -doubt ? Cover::all : Cover::partial;
}

// A disk is convex: a rectangle that is inside at both ends is inside all the time. For the rest the disk stands still
// and the rectangle moves backwards over a hexagon: its sides are sides of the first and the last rectangle and the
// paths of two corners. The point of them that is nearest to the centre decides, unless the centre is inside.
Cover cover(const GivenCircle& circle, Vec2 motion, Pixel origin, double shift, Rect r) noexcept {
  const LocalCircle at = seen_from(circle, origin, shift);
  const Cover first = cover(at, r);
  if (motion == Vec2{} || first == Cover::partial) return first;
  const Cover last = cover(seen_from(circle, origin, shift, motion), r);
  if (last != first) return Cover::partial;
  if (first == Cover::all) return first;
  // When the centre is in the rectangle. What rounding does to these times is as if the centre were some u of its
  // coordinates elsewhere: one that is inside and not found to be is as near to the sides.
  const Vec2 c{at.cx.hi, at.cy.hi};
  double from = 0, to = 1;
  const auto clip = [&](double v, double d, double lo, double hi) {
    if (d == 0) {
      if (v < lo || v > hi) to = -1;
      return;
    }
    const double a = (lo - v) / d, b = (hi - v) / d;
    from = std::max(from, std::min(a, b));
    to = std::min(to, std::max(a, b));
  };
  clip(c.x, motion.x, r.lo.x, r.hi.x);
  clip(c.y, motion.y, r.lo.y, r.hi.y);
  if (from <= to) return Cover::partial;
  // First and last rectangle were clear, and so is their nearest point. On a corner's path the excess is a parabola in
  // t: where its lowest point is off by some u |c|, that counts squared, less than u |c| itself for |c| below 2^52, and
  // farther disks are nowhere near. Points moved back err as in mark_inside_at(), where the doubt is doubled for it.
  const double ax = std::max(std::fabs(r.lo.x), std::fabs(r.hi.x)) + std::fabs(motion.x),
               ay = std::max(std::fabs(r.lo.y), std::fabs(r.hi.y)) + std::fabs(motion.y);
  const double doubt = 4 * at.doubt(ax, ay), length2 = motion.x * motion.x + motion.y * motion.y;
  for (const double x : {r.lo.x, r.hi.x}) {
    for (const double y : {r.lo.y, r.hi.y}) {
      const double t = std::clamp(((x - c.x) * motion.x + (y - c.y) * motion.y) / length2, 0.0, 1.0);
      if (at.excess(x - t * motion.x, y - t * motion.y) <= doubt) return Cover::partial;
    }
  }
  return Cover::none;
}

Circle boundary_circle(const GivenCircle& circle, const LocalCircle& at) noexcept {
  return {{at.cx.hi, at.cy.hi}, {at.cx.lo, at.cy.lo}, circle.radius, at.power};
}

bool overlap(const GivenCircle& a, const GivenCircle& b) noexcept {
  const double dx = a.center.x - b.center.x, dy = a.center.y - b.center.y, reach = a.radius + b.radius;
  const double distance2 = dx * dx + dy * dy, reach2 = reach * reach;
  // Both sides err by less than 4 u of themselves.
  if (distance2 > reach2 * (1 + 0x1p-49)) return false;
  if (distance2 < reach2 * (1 - 0x1p-49)) return true;
  Expansion sum;
  add_square_of_sum(a.center.x, -b.center.x, 1, sum);
  add_square_of_sum(a.center.y, -b.center.y, 1, sum);
  add_square_of_sum(a.radius, b.radius, -1, sum);
  return sum.sign() < 0;
}

}  // namespace moire
