// Random boards around a window and parts of it as the series under radial weights is given them: from every kind of
// camera, and wherever the horizon may be.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>

#include "engine/random_scenes.h"
#include "testimages/radial_series.h"

namespace moire::test {

// W at the origin, and its slope.
struct Level {
  double centre, slope;
  explicit Level(const LocalHomography& local) : centre(local.w.c.value()), slope(std::hypot(local.w.a, local.w.b)) {}
};

// A board that a window of that radius sees at least a part of: cameras with and without yaw and roll, their vanishing
// point anywhere or in the window, and planes that no camera needs to have seen, nearly singular ones and ones with
// coordinates up to 1e9 among them. The horizon passes through the window, the centre, next to its rim, or outside.
inline LocalHomography random_local(Draw& draw, double radius) {
  double rows = 0;  // from the horizon down to the centre, in radii
  switch (draw.integer(0, 4)) {
    case 0:
      rows = draw.uniform(-0.9, 0.9);
      break;
    case 1:
      rows = 0;
      break;
    case 2:
      rows = (draw.coin() ? 1 : -1) * (1 - draw.log_uniform(1e-9, 1e-1));
      break;
    case 3:
      rows = 1 + draw.log_uniform(1e-12, 1e-1);
      break;
    default:
      rows = draw.uniform(1, 5);
  }
  const double turn = draw.uniform(0, 7), finer = draw.log_uniform(1, 60);
  LocalHomography local{};
  const auto row = [&](double x, double y, double c) {  // in coordinates along and across the horizon
    return LocalHomography::Row{x * std::cos(turn) - y * std::sin(turn), x * std::sin(turn) + y * std::cos(turn), Dd(c),
                                0};
  };
  if (draw.integer(0, 2) > 0) {
    // A plane `height` squares below a camera without pitch; yaw turns the squares.
    const double focal = draw.log_uniform(10, 1000), yaw = draw.coin() ? 0 : draw.uniform(0, 7);
    const double c = std::cos(yaw), s = std::sin(yaw), height = draw.log_uniform(0.2, 3) * finer;
    const double column = draw.coin() ? draw.uniform(-1, 1) * radius : draw.uniform(-1, 1) * focal;
    local.u = row(height * c, 0, height * (column * c + focal * s));
    local.v = row(-height * s, 0, height * (focal * c - column * s));
    local.w = row(0, 1, rows * radius);
  } else {
    const double tilt = draw.log_uniform(1e-4, 1), size = draw.uniform(0.2, 2) * finer;
    const double other = draw.coin() ? draw.log_uniform(1e-6, 1) : 1;
    local.u = row(draw.uniform(-1, 1) * size, draw.uniform(-1, 1) * size, draw.uniform(-1, 1) * size);
    local.v = row(draw.uniform(-1, 1) * size * other, draw.uniform(-1, 1) * size * other, draw.uniform(-1, 1) * size);
    local.w = row(0, tilt, tilt * rows * radius);
    // So many squares further from the plane's origin.
    const double far = draw.coin() ? std::round(draw.log_uniform(1, 1e9)) : 0;
    local.u.a += far * local.w.a;
    local.u.b += far * local.w.b;
    local.u.c = local.u.c + Dd(far) * local.w.c;
  }
  return local;
}

// W up to a random depth; with a notch where there is room for one and `notch` says so. No answer where the part would
// be empty, or pass the origin too near.
inline std::optional<RadialPart> random_part(Draw& draw, const LocalHomography& local, double radius, bool notch) {
  const Level w(local);
  const double low = std::max(w.centre - w.slope * radius, 0.0), high = w.centre + w.slope * radius;
  const double clear = RadialPart::clearance(radius) * w.slope;
  if (!(high > 0 && w.slope > 0)) return std::nullopt;
  double depth = low + (high - low) * (draw.coin() ? draw.log_uniform(1e-3, 1) : draw.uniform(0, 1.1));
  // As near to the origin as may be.
  if (draw.integer(0, 3) == 0) depth = w.centre + (draw.coin() ? 1 : -1) * clear * draw.uniform(1.001, 4);
  if (!(depth > low) || !(std::fabs(depth - w.centre) >= clear)) return std::nullopt;
  if (!notch) return RadialPart{depth};
  const double bottom = std::max(depth * draw.uniform(0.1, 0.9), w.centre - 0.7 * radius * w.slope);
  if (!(bottom > 0 && std::fabs(bottom - w.centre) >= clear && bottom + clear < depth)) return std::nullopt;
  // Its corners are inside the support.
  const double rise = (depth - w.centre) / w.slope, fall = (bottom - w.centre) / w.slope;
  const double room = std::max(std::fabs(rise), std::fabs(fall));
  const double widest = std::sqrt(std::max(0.0, (radius - room) * (radius + room)));
  const double half = std::min(0.7 * radius, 0.95 * widest) * draw.uniform(0.05, 1);
  if (!(half >= RadialPart::clearance(radius))) return std::nullopt;
  return RadialPart{depth, half, bottom};
}

}  // namespace moire::test
