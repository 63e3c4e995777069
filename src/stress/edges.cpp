// Edges that hurt: nearly along sides and diagonals, on knot lines and corners, far from the origin, moving.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include "oracle/quad.h"
#include "stress/exact_case.h"
#include "stress/naive.h"
#include "stress/scenes.h"

namespace moire::stress {
namespace {

enum Kind : std::uint64_t {
  nearly_straight,  // within 1e-16 .. 1e-3 of a multiple of 45 degrees, through a corner or a knot
  along_knots,      // on a knot line or one double beside it
  through_corners,  // through two crossings of knot lines
  far_away,         // image offsets up to 2^40 pixels
  point_far_along,  // `through` up to 2^40 pixels along the edge
  cut_corner,       // the window's outermost corner cut 1e-16 .. 1e-2 pixel deep
  any_length,       // normals of length 1e-300 .. 1e300
  in_degrees,       // the normal at or within 1e-16 .. 1e-3 degrees of a multiple of 45, or any other
  in_motion,
  kKinds
};

constexpr double kFarthest = 0x1p40;  // pixels: where exact values promise their accuracy

struct Place {
  Pixel pixel;
  Vec2 centre;  // exact
};

Place place_at(Pixel pixel) {
  return {pixel, {static_cast<double>(pixel.x) + 0.5, static_cast<double>(pixel.y) + 0.5}};
}

Place near_origin(Chance& chance) {
  const auto coordinate = [&] { return static_cast<std::int64_t>(chance.below(1024)) - 512; };
  const std::int64_t x = coordinate();
  return place_at({x, coordinate()});
}

Place far_off(Chance& chance) {
  const auto coordinate = [&] { return static_cast<std::int64_t>(chance.sign() * chance.decades(1, kFarthest)); };
  const std::int64_t x = coordinate();
  return place_at({x, coordinate()});
}

// On a knot or beside it by up to 1e-3 pixel, as far as doubles allow there.
double touchy(Chance& chance, double centre, const std::vector<double>& knots) {
  const double on = centre + chance.pick(knots);
  const std::uint64_t way = chance.below(3);
  if (way == 0) return on;
  if (way == 1) return std::nextafter(on, chance.sign() * HUGE_VAL);
  return on + chance.sign() * chance.decades(1e-16, 1e-3);
}

Vec2 direction(double angle) { return {std::cos(angle), std::sin(angle)}; }
Vec2 any_direction(Chance& chance) { return direction(chance.between(0, 2 * std::numbers::pi)); }

// One of the eight directions along sides and diagonals, with components of 0, 1 and -1.
Vec2 straight(Chance& chance) {
  constexpr Vec2 kEight[] = {{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}};
  return chance.pick(kEight);
}

Vec2 nearly_straight_normal(Chance& chance) {
  const Vec2 n = straight(chance);
  const double turn = chance.sign() * chance.decades(1e-16, 1e-3);
  return {n.x - turn * n.y, n.y + turn * n.x};
}

// The largest coordinate in play over the angle to the nearest of the eight directions, where there is one.
double severity(Vec2 centre, Vec2 through, Vec2 n) {
  const double far =
      std::max({1.0, std::fabs(centre.x), std::fabs(centre.y), std::fabs(through.x), std::fabs(through.y)});
  const double longer = std::max(std::fabs(n.x), std::fabs(n.y)), shorter = std::min(std::fabs(n.x), std::fabs(n.y));
  const double tilt = std::min(shorter, longer - shorter) / longer;
  return far / (tilt > 0 ? tilt : 1);
}

ExactCase finished(TestImage image, const Place& place, FilterPtr filter) {
  const oracle::Edge edge = oracle::edge_of(image);
  ExactCase c{std::move(image), place.pixel, std::move(filter)};
  c.severity = severity(place.centre, {edge.through[0], edge.through[1]}, {edge.normal[0], edge.normal[1]});
  if (c.filter->is_box && !c.image.moves()) c.naive = naive_coverage(edge, place.pixel, 2 * c.filter->filter.radius());
  return c;
}

// Up to ten pixels, across the window at some time; along an axis or along the edge now and then.
ExactCase moving_case(Chance& chance) {
  // The oracle integrates over time, too: a tenth of a second under a cubic.
  const std::uint64_t way = chance.below(32);
  const FilterPtr filter = checked_filter(way == 0 ? "mitchell" : way < 12 ? "tent" : "box");
  const Place place = near_origin(chance);
  const Vec2 n = chance.coin() ? any_direction(chance) : nearly_straight_normal(chance);
  const double length = chance.decades(1e-3, 10);
  Vec2 to = chance.coin() ? any_direction(chance) : straight(chance);
  if (chance.below(8) == 0) to = {-n.y, n.x};
  const Vec2 motion{length * to.x, length * to.y};
  const double when = chance.unit();
  const std::vector<double> knots = filter->knots();
  const double x = touchy(chance, place.centre.x, knots), y = touchy(chance, place.centre.y, knots);
  return finished(scenes::moving_edge({x - when * motion.x, y - when * motion.y}, n, motion), place, filter);
}

struct QuadVector {
  oracle::Quad x, y;
};

// Cosine and sine of an angle in degrees, right to some 2^-110 of each: the angle to the nearest axis is a double, and
// within 45 degrees both are sums of Taylor's series that hardly cancel.
QuadVector true_direction(double degrees) {
  using oracle::Quad;
  // The nearest of 113 bits, in two parts.
  const Quad pi = oracle::widen(0xc.90fdaa22168c235p-2L) - oracle::widen(0xe.ce675d1fc9p-68L);
  int quarters = 0;
  const Quad angle = oracle::widen(std::remquo(degrees, 90.0, &quarters)) * pi / 180;
  Quad c = 1, s = angle, term = angle;
  for (int n = 2; n < 40; ++n) {
    term *= angle / n;
    (n % 2 == 0 ? c : s) += n / 2 % 2 == 0 ? term : -term;
  }
  QuadVector v{c, s};
  for (int i = 0; i < ((quarters % 4) + 4) % 4; ++i) v = {-v.y, v.x};
  return v;
}

// What is wrong with the components that a scene made of degrees: more than one unit in the last place of the true
// component off, unequal at 45 degrees or not 0 along an axis. "": nothing.
std::string fault_of_direction(double degrees, Vec2 n) {
  const auto wrong = [](double got, oracle::Quad wanted) {
    const double rounded = static_cast<double>(oracle::abs(wanted));
    if (rounded == 0) return got != 0;
    const double ulp = std::ldexp(1.0, std::ilogb(rounded) - 52);
    return !(oracle::abs(oracle::widen(got) - wanted) <= oracle::widen(ulp));
  };
  const QuadVector wanted = true_direction(degrees);
  const bool diagonal = std::fabs(std::remainder(degrees, 90.0)) == 45;
  if (!wrong(n.x, wanted.x) && !wrong(n.y, wanted.y) && !(diagonal && std::fabs(n.x) != std::fabs(n.y))) return {};
  return fmt::format("the normal of {:.17g} degrees is [{:.17g}, {:.17g}] where [{:.17g}, {:.17g}] is nearest", degrees,
                     n.x, n.y, static_cast<double>(wanted.x), static_cast<double>(wanted.y));
}

ExactCase in_degrees_case(Chance& chance, FilterPtr filter) {
  const std::vector<double> knots = filter->knots();
  const Place place = near_origin(chance);
  const Vec2 through{touchy(chance, place.centre.x, knots), touchy(chance, place.centre.y, knots)};
  const double straight = 45 * (static_cast<double>(chance.below(33)) - 16);  // up to two turns either way
  double degrees = straight;
  const std::uint64_t way = chance.below(4);
  if (way == 1) degrees = std::nextafter(straight, chance.sign() * HUGE_VAL);
  if (way == 2) degrees = straight + chance.sign() * chance.decades(1e-16, 1e-3);
  if (way == 3) degrees = chance.sign() * chance.decades(1e-3, 1e6);
  ExactCase c = finished(scenes::edge(through, degrees), place, std::move(filter));
  const oracle::Edge edge = oracle::edge_of(c.image);
  c.fault = fault_of_direction(degrees, {edge.normal[0], edge.normal[1]});
  return c;
}

ExactCase make_case(CaseKey key) {
  Chance chance("edges", key);
  const std::uint64_t kind = key.index % kKinds;
  if (kind == in_motion) return moving_case(chance);
  const FilterPtr filter = pick_filter(chance);
  if (kind == in_degrees) return in_degrees_case(chance, filter);
  const std::vector<double> knots = filter->knots();
  const double reach = filter->filter.radius();
  const Place place = kind == far_away ? far_off(chance) : near_origin(chance);
  Vec2 through{touchy(chance, place.centre.x, knots), touchy(chance, place.centre.y, knots)};
  Vec2 normal = any_direction(chance);
  switch (kind) {
    case nearly_straight:
      normal = nearly_straight_normal(chance);
      break;
    case along_knots:
      normal = straight(chance);
      break;
    case through_corners: {
      const double dx = chance.pick(knots) - chance.pick(knots), dy = chance.pick(knots) - chance.pick(knots);
      through = {place.centre.x + chance.pick(knots), place.centre.y + chance.pick(knots)};
      if (dx != 0 || dy != 0) normal = {-dy, dx};
      break;
    }
    case far_away:
      if (chance.coin()) normal = nearly_straight_normal(chance);
      break;
    case point_far_along: {
      const double away = chance.sign() * chance.decades(1, kFarthest);
      if (chance.coin()) normal = nearly_straight_normal(chance);
      through = {through.x - away * normal.y, through.y + away * normal.x};
      break;
    }
    case cut_corner: {
      if (chance.coin()) normal = nearly_straight_normal(chance);
      const double deep = chance.decades(1e-16, 1e-2);
      through = {place.centre.x + std::copysign(reach, normal.x) - deep * normal.x,
                 place.centre.y + std::copysign(reach, normal.y) - deep * normal.y};
      break;
    }
    default: {
      const double length = chance.decades(1e-300, 1e300);
      normal = {length * normal.x, length * normal.y};
      through = {place.centre.x + reach * chance.between(-1, 1), place.centre.y + reach * chance.between(-1, 1)};
    }
  }
  return finished(scenes::edge(through, normal), place, filter);
}

}  // namespace

extern const Family edges;
constinit const Family edges = {
    .name = "edges",
    .title = "half-planes along sides and diagonals, through corners, in degrees, far from the origin, moving",
    .quantity = "exact value of a pixel under any filter",
    .severity = "coordinate over angle to axis or diagonal, px",
    .claim = "the printed bound of `moire exact --pixels`",
    .share = 1,
    .run = [](CaseKey key) { return run(make_case(key)); },
    .describe = [](CaseKey key) { return describe(make_case(key)); }};

}  // namespace moire::stress
