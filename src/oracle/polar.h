// A second way to filtered values, to check the first: quadrature along rays from a pole, then over their directions.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "oracle/kernel.h"
#include "oracle/scene.h"

namespace moire::oracle {

// What a ray holds of the scene: distances from the pole.
struct Ray {
  long double from, to;
};

// Integral of k(x) k(y) over a set that every ray from `pole` meets in one interval, ray(cos, sin). `bends` are points
// where the set's boundary meets the kernel's knots. Adaptive in the direction; meant for a few hundred pixels.
template <class F>
Value polar(const Kernel& k, Point pole, std::vector<Point> bends, const F& ray) {
  for (const long double x : k.knots())
    for (const long double y : k.knots()) bends.push_back({widen(x), widen(y)});
  constexpr long double kPi = std::numbers::pi_v<long double>;
  const auto px = narrow(pole.x), py = narrow(pole.y);
  std::vector<long double> turn{-kPi, -kPi / 2, 0, kPi / 2, kPi};
  for (const Point& b : bends) turn.push_back(std::atan2(narrow(b.y) - py, narrow(b.x) - px));
  std::sort(turn.begin(), turn.end());
  const Rule along(20);
  const RulePair around{Rule(16), Rule(24)};
  const auto one_ray = [&](long double angle) {
    const long double c = std::cos(angle), s = std::sin(angle);
    const Ray r = ray(c, s);
    std::vector<long double> cut{r.from, r.to};
    long double enter = std::max(r.from, 0.0L), leave = r.to;
    for (const long double knot : k.knots()) {
      cut.push_back((knot - px) / c);
      cut.push_back((knot - py) / s);
    }
    // The window's part of the ray.
    const auto bound = [&](long double p, long double d) {
      const long double a = (-k.radius() - p) / d, b = (k.radius() - p) / d;
      enter = std::max(enter, std::min(a, b));
      leave = std::min(leave, std::max(a, b));
    };
    bound(px, c);
    bound(py, s);
    std::sort(cut.begin(), cut.end());
    long double sum = 0;
    for (std::size_t i = 0; i + 1 < cut.size(); ++i) {
      const long double a = std::max(cut[i], enter), b = std::min(cut[i + 1], leave);
      if (!(a < b)) continue;
      const long double mid = (a + b) / 2, half = (b - a) / 2;
      for (std::size_t n = 0; n < along.x.size(); ++n) {
        const long double d = mid + half * along.x[n];
        sum += half * along.w[n] * d * k(px + d * c) * k(py + d * s);
      }
    }
    return sum;
  };
  Value v;
  for (std::size_t i = 0; i + 1 < turn.size(); ++i)
    if (turn[i] < turn[i + 1]) v += integrate(around, one_ray, turn[i], turn[i + 1]);
  return v;
}

// The half-plane from the pixel's centre.
inline Value polar(const Kernel& k, const HalfPlane& h) {
  const auto nx = narrow(h.nx), ny = narrow(h.ny), d = narrow(h.offset);
  std::vector<Point> bends;
  for (const long double knot : k.knots()) {
    if (ny != 0) bends.push_back({widen(knot), widen(-(d + nx * knot) / ny)});
    if (nx != 0) bends.push_back({widen(-(d + ny * knot) / nx), widen(knot)});
  }
  return polar(k, {0, 0}, bends, [=](long double c, long double s) {
    const long double slope = nx * c + ny * s, hit = -d / slope, far = 1e30L;
    if (d >= 0) return Ray{0, slope < 0 ? hit : far};
    return slope > 0 ? Ray{hit, far} : Ray{0, 0};
  });
}

// The disk from its own centre.
inline Value polar(const Kernel& k, const Circle& circle) {
  std::vector<Point> bends;
  const Point c = circle.center;
  const Quad r = circle.radius;
  for (const long double knot : k.knots())
    for (const Quad sign : {Quad(-1), Quad(1)}) {
      const Quad dx = widen(knot) - c.x, dy = widen(knot) - c.y;
      bends.push_back({widen(knot), c.y + sign * sqrt((r - dx) * (r + dx))});
      bends.push_back({c.x + sign * sqrt((r - dy) * (r + dy)), widen(knot)});
    }
  const auto radius = narrow(r);
  return polar(k, c, bends, [=](long double, long double) { return Ray{0, radius}; });
}

}  // namespace moire::oracle
