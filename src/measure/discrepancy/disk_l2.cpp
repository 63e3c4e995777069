// T^2 of disks as a sum over pairs of points and their images.
#include "measure/discrepancy/disk_l2.h"

#include <cassert>
#include <cstdint>

#include "core/dd_math.h"
#include "measure/discrepancy/disk_overlap.h"
#include "measure/discrepancy/disk_pairs.h"
#include "measure/discrepancy/pair_sum.h"

namespace moire {
namespace {

// The mean over ordered pairs of the images' overlaps.
Dd mean_overlap(const PointView& points, const DiskOverlap& overlap, double radius) {
  const double scale = 1 / (4 * radius * radius);
  const DiskTerms terms = (radius <= 0.25 ? disk_terms_of_one_image() : disk_terms()).back();
  const Dd all = sum_over_pairs(points, [&](PairBlock rows, PairBlock columns) {
    return sum_of_rows([&](double row_x, double row_y, std::span<const double> x, std::span<const double> y,
                           PairRow& sum) { terms(overlap, scale, row_x, row_y, x, y, sum); },
                       rows, columns);
  });
  const Dd n = dd_from_integer(static_cast<std::int64_t>(points.size()));
  return all / n / n;
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
