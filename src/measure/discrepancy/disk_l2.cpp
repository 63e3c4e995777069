// T^2 of disks as a sum over pairs of points and their images.
#include "measure/discrepancy/disk_l2.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>

#include "core/dd_math.h"
#include "measure/discrepancy/disk_overlap.h"
#include "measure/discrepancy/pair_sum.h"

namespace moire {
namespace {

// Disks of diameter 2R <= 1/2: at most one image of the other point is that near, the nearest along both axes.
struct OneImage {
  const DiskOverlap* overlap;
  double scale;  // 1 / (2R)^2
  double operator()(double dx, double dy) const noexcept {
    const double a = std::fabs(dx), b = std::fabs(dy);
    const double x = std::min(a, 1 - a), y = std::min(b, 1 - b);
    return (*overlap)((x * x + y * y) * scale);
  }
};

// 2R <= 1: four images, the nearest and the next one along each axis; all others are 1 away or more.
struct FourImages {
  const DiskOverlap* overlap;
  double scale;
  double operator()(double dx, double dy) const noexcept {
    const double a = std::fabs(dx), b = std::fabs(dy);
    const double x = std::min(a, 1 - a), far_x = std::max(a, 1 - a), y = std::min(b, 1 - b), far_y = std::max(b, 1 - b);
    const double x2 = x * x * scale, y2 = y * y * scale, far_x2 = far_x * far_x * scale, far_y2 = far_y * far_y * scale;
    return ((*overlap)(x2 + y2) + (*overlap)(far_x2 + far_y2)) + ((*overlap)(far_x2 + y2) + (*overlap)(x2 + far_y2));
  }
};

// The mean over ordered pairs of the images' overlaps.
Dd mean_overlap(const PointView& points, const DiskOverlap& overlap, double radius) {
  const double scale = 1 / (4 * radius * radius);
  const auto sum = [&](const auto& term) {
    return sum_over_pairs(points, [&](PairBlock rows, PairBlock columns) { return sum_of_tile(term, rows, columns); });
  };
  const Dd n = dd_from_integer(static_cast<std::int64_t>(points.size()));
  return (radius <= 0.25 ? sum(OneImage{&overlap, scale}) : sum(FourImages{&overlap, scale})) / n / n;
}

}  // namespace

double disk_l2_squared(const PointView& points) {
  // 2 (R^3 mean - pi^2 R^5 / 5) for R = 1/2
  return (Dd(0.25) * mean_overlap(points, DiskOverlap::mean_lens(), 0.5) - kPi * kPi / Dd(80.0)).value();
}

double disk_l2_squared(const PointView& points, double radius) {
  assert(radius > 0 && radius <= 0.5);
  const Dd r2 = two_prod(radius, radius);
  return (r2 * (mean_overlap(points, DiskOverlap::lens(), radius) - kPi * kPi * r2)).value();
}

}  // namespace moire
