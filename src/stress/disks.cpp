// Disks that hurt: far smaller and far larger than a pixel, tangent to sides and corners, centred on corners, moving.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "stress/exact_case.h"
#include "stress/naive.h"
#include "stress/scenes.h"

namespace moire::stress {
namespace {

enum Kind : std::uint64_t {
  tiny,            // radius 1e-12 .. 1e-2 pixel, anywhere in the window
  tiny_on_knots,   // the same across knot lines and corners
  tangent,         // to a knot line or two, give or take a double
  through_corner,  // of knot lines
  huge,            // radius 1e3 .. 1e12 pixels, across the window
  huge_tangent,    // the same, touching a knot line
  centred,         // on corners, knots and the pixel's centre, radii that reach corners and sides
  far_away,        // image offsets up to 2^40 pixels
  in_motion,
  kKinds
};

constexpr double kFarthest = 0x1p40;
double nudged(Chance& chance, double x) {
  for (std::uint64_t n = chance.below(4); n > 0; --n) x = std::nextafter(x, chance.sign() * HUGE_VAL);
  return x;
}

// The largest of radius, its inverse and the coordinates, in pixels.
ExactCase finished(TestImage image, Pixel pixel, FilterPtr filter) {
  const oracle::Disk disk = oracle::disk_of(image);
  ExactCase c{std::move(image), pixel, std::move(filter)};
  c.severity = std::max({disk.radius, 1 / disk.radius, std::fabs(disk.center[0]), std::fabs(disk.center[1])});
  if (c.filter->is_box && !c.image.moves()) c.naive = naive_coverage(disk, pixel, 2 * c.filter->filter.radius());
  return c;
}

ExactCase moving_case(Chance& chance) {
  const double x = chance.between(3, 6), y = chance.between(3, 6), r = chance.decades(1e-2, 1e3);
  const double angle = chance.between(0, 2 * std::numbers::pi), way = chance.between(0, 2 * std::numbers::pi);
  const double length = chance.decades(1e-3, 10), when = chance.unit();
  const Vec2 motion{length * std::cos(way), chance.below(4) == 0 ? 0 : length * std::sin(way)};
  const Vec2 center{x - r * std::cos(angle) - when * motion.x, y - r * std::sin(angle) - when * motion.y};
  return finished(scenes::moving_disk(center, r, motion), {4, 4}, checked_filter("box"));
}

ExactCase make_case(CaseKey key) {
  Chance chance("disks", key);
  const std::uint64_t kind = key.index % kKinds;
  if (kind == in_motion) return moving_case(chance);
  const FilterPtr filter = pick_filter(chance);
  const std::vector<double> knots = filter->knots();
  const double reach = filter->filter.radius();
  const auto coordinate = [&] {
    return kind == far_away ? static_cast<std::int64_t>(chance.sign() * chance.decades(1, kFarthest))
                            : static_cast<std::int64_t>(chance.below(1024)) - 512;
  };
  Pixel pixel;
  pixel.x = coordinate();
  pixel.y = coordinate();
  const Vec2 centre{static_cast<double>(pixel.x) + 0.5, static_cast<double>(pixel.y) + 0.5};
  const auto knot_x = [&] { return centre.x + chance.pick(knots); };
  const auto knot_y = [&] { return centre.y + chance.pick(knots); };
  const Vec2 anywhere{centre.x + reach * chance.between(-1, 1), centre.y + reach * chance.between(-1, 1)};
  const double angle = chance.between(0, 2 * std::numbers::pi), c = std::cos(angle), s = std::sin(angle);
  Vec2 center = anywhere;
  double r = chance.decades(1e-12, 1e-2);
  switch (kind) {
    case tiny:
      break;
    case tiny_on_knots:
      center = {knot_x(), knot_y()};
      if (chance.coin()) (chance.coin() ? center.x = anywhere.x : center.y = anywhere.y);
      if (chance.coin()) center = {center.x + r * chance.between(-1, 1), center.y + r * chance.between(-1, 1)};
      break;
    case tangent:
      r = chance.decades(1e-3, 1e3);
      center = {nudged(chance, knot_x() + chance.sign() * r),
                chance.coin() ? nudged(chance, knot_y() + chance.sign() * r) : anywhere.y};
      if (chance.coin()) center = {chance.coin() ? knot_x() : anywhere.x, nudged(chance, knot_y() + chance.sign() * r)};
      break;
    case through_corner: {
      r = chance.decades(1e-3, 1e3);
      const bool triangle = chance.coin();  // 3-4-5, or any angle
      center = {knot_x() + r * (triangle ? 0.6 : c), knot_y() - r * (triangle ? 0.8 : s)};
      break;
    }
    case huge:
      r = chance.decades(1e3, 1e12);
      center = {anywhere.x - r * c, anywhere.y - r * s};
      break;
    case huge_tangent:
      r = chance.decades(1e3, 1e12);
      center = chance.coin() ? Vec2{knot_x() + chance.sign() * r, anywhere.y} : Vec2{anywhere.x, knot_y() - r};
      break;
    case centred: {
      center = chance.coin() ? Vec2{knot_x(), knot_y()} : centre;
      const double steps[] = {0.25, 0.5, 0.75, 1, std::sqrt(0.5), std::sqrt(2.0), 1.5, reach, 2 * reach};
      r = nudged(chance, chance.pick(steps));
      break;
    }
    default:
      r = chance.decades(1e-6, 1e6);
      center = {anywhere.x - r * c, anywhere.y - r * s};
  }
  return finished(scenes::disk(center, r), pixel, filter);
}

}  // namespace

extern const Family disks;
constinit const Family disks = {
    .name = "disks",
    .title = "disks of radius 1e-12 to 1e12, tangent, centred on corners, far from the origin, moving",
    .quantity = "exact value of a pixel under any filter",
    .severity = "largest of radius, 1 / radius, coordinates",
    .claim = "the printed bound of `moire exact --pixels`; a tiny disk's shrinks with its area",
    .share = 1,
    .run = [](CaseKey key) { return run(make_case(key)); },
    .describe = [](CaseKey key) { return describe(make_case(key)); }};

}  // namespace moire::stress
