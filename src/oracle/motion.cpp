// Quadrature over time; see motion.h.
#include "oracle/motion.h"

#include <algorithm>
#include <vector>

#include "oracle/coverage.h"
#include "oracle/filtered.h"
#include "oracle/quadrature.h"

namespace moire::oracle {
namespace {

// Times between 0 and 1, in order, those two among them.
std::vector<Quad> within_shutter(std::vector<Quad> times) {
  std::erase_if(times, [](Quad t) { return !(t > 0 && t < 1); });
  times.push_back(0);
  times.push_back(1);
  std::sort(times.begin(), times.end());
  return times;
}

}  // namespace

Value moving(const Kernel& k, const Edge& edge, Vec2 motion, Pixel pixel) {
  const HalfPlane start = around(edge, pixel);
  const Quad travel = start.nx * widen(motion.x) + start.ny * widen(motion.y);
  std::vector<Quad> times;
  if (travel != 0)
    for (const long double x : k.knots())
      for (const long double y : k.knots())
        times.push_back((start.nx * widen(x) + start.ny * widen(y) + start.offset) / travel);
  times = within_shutter(std::move(times));
  // Of degree 2 d + 2 in time for a kernel of degree d <= 2.
  const RulePair rules{Rule(5), Rule(7)};
  long double still_error = 0;
  const auto still = [&](Quad t) {
    const Value v = filtered(k, HalfPlane{start.nx, start.ny, start.offset - t * travel});
    still_error = std::max(still_error, v.error);
    return v.value;
  };
  Value mean;
  for (std::size_t i = 0; i + 1 < times.size(); ++i)
    if (times[i] < times[i + 1]) mean += integrate(rules, still, times[i], times[i + 1]);
  mean.error += still_error;
  return mean;
}

Value moving(const Disk& disk, Vec2 motion, Pixel pixel, double width) {
  const Circle start = around(disk, pixel);
  const Quad dx = widen(motion.x), dy = widen(motion.y), r = start.radius, length2 = dx * dx + dy * dy;
  std::vector<Quad> times;
  for (const Quad side : {-widen(width) / 2, widen(width) / 2}) {
    for (const Quad extreme : {-r, r}) {
      if (dx != 0) times.push_back((side - extreme - start.center.x) / dx);
      if (dy != 0) times.push_back((side - extreme - start.center.y) / dy);
    }
    for (const Quad other : {-widen(width) / 2, widen(width) / 2}) {
      const Quad x = side - start.center.x, y = other - start.center.y;
      const Quad mid = (x * dx + y * dy) / length2, miss2 = (x * dy - y * dx) * (x * dy - y * dx) / length2;
      if (miss2 >= r * r) continue;
      const Quad half = sqrt((r * r - miss2) / length2);
      times.push_back(mid - half);
      times.push_back(mid + half);
    }
  }
  times = within_shutter(std::move(times));
  const RulePair rules{Rule(12), Rule(20)};
  long double still_error = 0;
  Value mean;
  for (std::size_t i = 0; i + 1 < times.size(); ++i) {
    const Quad a = times[i], length = times[i + 1] - a;
    if (!(length > 0)) continue;
    // t = a + length s^2 (3 - 2 s): both ends are approached like a square, which turns their roots into polynomials.
    mean += integrate(
        rules,
        [&](Quad s) {
          const Quad t = a + length * s * s * (3 - 2 * s);
          const Value v = coverage(Circle{{start.center.x + t * dx, start.center.y + t * dy}, r}, width);
          still_error = std::max(still_error, v.error);
          return v.value * narrow(length * 6 * s * (1 - s));
        },
        Quad(0), Quad(1));
  }
  mean.error += still_error;
  return mean;
}

}  // namespace moire::oracle
