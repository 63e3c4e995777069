// An independent way to a moving scene's pixel value: the still engine at many times, integrated over time. Between the
// times at which the boundary passes a corner of the kernel's knots, or touches one of their lines, the still value is
// analytic, with a root of (t - t0) at a touch at most; t = a + (b - a) (3 s^2 - 2 s^3) makes that smooth.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "curve/quadrature.h"
#include "engine/exact.h"
#include "moving_scenes.h"

namespace moire::test {

// An edge (radius 0) or a disk that moves.
struct MovingShape {
  Vec2 at;      // a point of the edge, or the centre
  Vec2 normal;  // of the edge
  double radius = 0;
  Vec2 motion;

  bool is_disk() const { return radius > 0; }
  TestImage image() const {
    return is_disk() ? scenes::moving_disk(at, radius, motion) : scenes::moving_edge(at, normal, motion);
  }
  TestImage still(double t) const {
    const Vec2 p{at.x + t * motion.x, at.y + t * motion.y};
    return is_disk() ? scenes::disk(p, radius) : scenes::edge(p, normal);
  }
};

// Times in (0, 1) at which the still value of the pixel may change its formula, with 0 and 1 around them.
inline std::vector<double> break_times(const MovingShape& s, const Kernel& kernel, Pixel pixel) {
  std::vector<double> times{0, 1};
  const Vec2 d = s.motion;
  const auto place = [](std::int64_t i, double knot) { return static_cast<double>(i) + 0.5 + knot; };
  for (const double kx : kernel.knots()) {
    const double x = place(pixel.x, kx), y_line = place(pixel.y, kx);
    if (s.is_disk()) {
      for (const double side : {-s.radius, s.radius}) {
        times.push_back((x - side - s.at.x) / d.x);
        times.push_back((y_line - side - s.at.y) / d.y);
      }
    }
    for (const double ky : kernel.knots()) {
      const Vec2 to{x - s.at.x, place(pixel.y, ky) - s.at.y};
      if (!s.is_disk()) {
        times.push_back((s.normal.x * to.x + s.normal.y * to.y) / (s.normal.x * d.x + s.normal.y * d.y));
        continue;
      }
      const double length2 = d.x * d.x + d.y * d.y, mid = (to.x * d.x + to.y * d.y) / length2;
      const double across = (to.x * d.y - to.y * d.x) / std::sqrt(length2);
      const double half = std::sqrt((s.radius - across) * (s.radius + across) / length2);
      times.push_back(mid - half);
      times.push_back(mid + half);
    }
  }
  std::erase_if(times, [](double t) { return !(t >= 0 && t <= 1); });
  std::sort(times.begin(), times.end());
  times.erase(std::unique(times.begin(), times.end()), times.end());
  return times;
}

struct TimeAverage {
  double value = 0, error = 0;
};

// The mean over time of the still value, and about how far off it is.
inline TimeAverage time_average(const MovingShape& shape, const Filter& filter, Pixel pixel) {
  TimeAverage sum;
  double still_bound = 0;
  const auto still = [&](double t) {
    const Exact e = exact_pixel(shape.still(t), filter, pixel);
    still_bound = std::max(still_bound, e.bound);
    return e.value;
  };
  const auto panel = [&](double a, double b, double s0, double s1, int n) {
    const Rule rule = gauss_legendre(n);
    double total = 0;
    for (std::size_t i = 0; i < rule.node.size(); ++i) {
      const double s = 0.5 * (s0 + s1) + 0.5 * (s1 - s0) * rule.node[i];
      // From the nearer end, so that short times are not rounded away.
      const double t = s < 0.5 ? a + (b - a) * s * s * (3 - 2 * s) : b - (b - a) * (1 - s) * (1 - s) * (1 + 2 * s);
      total += rule.weight[i] * 6 * s * (1 - s) * still(t);
    }
    return 0.5 * (s1 - s0) * (b - a) * total;
  };
  const auto integrate = [&](const auto& self, double a, double b, double s0, double s1, int depth) -> void {
    const double rough = panel(a, b, s0, s1, 12), fine = panel(a, b, s0, s1, 20);
    if (std::fabs(rough - fine) > 1e-15 && depth < 12 && (b - a) * (s1 - s0) > 1e-9) {
      self(self, a, b, s0, 0.5 * (s0 + s1), depth + 1);
      self(self, a, b, 0.5 * (s0 + s1), s1, depth + 1);
      return;
    }
    sum.value += fine;
    sum.error += std::fabs(rough - fine);
  };
  const std::vector<double> times = break_times(shape, filter.kernel(), pixel);
  for (std::size_t i = 0; i + 1 < times.size(); ++i) integrate(integrate, times[i], times[i + 1], 0, 1, 0);
  // A moved point is rounded to half an ulp in each coordinate; a value changes by at most the total variation of k,
  // below 8 for every filter here, times the distance.
  const double largest =
      std::max(std::fabs(shape.at.x) + std::fabs(shape.motion.x), std::fabs(shape.at.y) + std::fabs(shape.motion.y));
  sum.error += still_bound + 1e-15 + 8 * 3 * 0x1p-53 * largest;
  return sum;
}

}  // namespace moire::test
