// A circle seen from a pixel; see circle.h.
#include "testimages/circle.h"

#include "core/error.h"
#include "core/expansion.h"
#include "testimages/scene_args.h"

namespace moire {
namespace {

// The sign of |origin + p - center|^2 - radius^2, exactly.
int exact_sign(const GivenCircle& circle, Pixel origin, Vec2 p) noexcept {
  Expansion sum;
  const Dd ox = dd_from_integer(origin.x), oy = dd_from_integer(origin.y);
  const double terms[2][4] = {{p.x, ox.hi, ox.lo, -circle.center.x}, {p.y, oy.hi, oy.lo, -circle.center.y}};
  for (const auto& t : terms) {
    for (int i = 0; i < 4; ++i) {
      sum.add_product(t[i], t[i]);
      for (int j = i + 1; j < 4; ++j) sum.add_product(2 * t[i], t[j]);
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

LocalCircle seen_from(const GivenCircle& circle, Pixel origin, double shift) noexcept {
  const Dd cx = Dd(circle.center.x) - dd_from_integer(origin.x) - Dd(shift);
  const Dd cy = Dd(circle.center.y) - dd_from_integer(origin.y) - Dd(shift);
  return {cx, cy, (two_prod(circle.radius, circle.radius) - cx * cx - cy * cy).value()};
}

void mark_inside(const GivenCircle& circle, Pixel origin, std::span<const double> x, std::span<const double> y,
                 Vec2 reach, std::span<std::uint8_t> inside) noexcept {
  const LocalCircle at = seen_from(circle, origin, 0);
  const double doubt = at.doubt(reach.x, reach.y);
  bool doubtful = false;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double e = at.excess(x[i], y[i]);
    inside[i] |= static_cast<std::uint8_t>(e < -doubt);
    doubtful |= std::fabs(e) <= doubt;
  }
  if (!doubtful) return;
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (std::fabs(at.excess(x[i], y[i])) > doubt) continue;
    inside[i] |= static_cast<std::uint8_t>(exact_sign(circle, origin, {x[i], y[i]}) <= 0);
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
