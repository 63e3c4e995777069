// T^2 of edges from three means of P, the probability that a line separates two points: two of the set, one of the set
// and one of the square, two of the square.
#include "measure/discrepancy/edge_l2.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "core/sum.h"
#include "measure/discrepancy/edge_pairs.h"

namespace moire {
namespace {

// A rectangle as thin as this counts for nothing, and its sides' ratio could overflow.
constexpr double kNothing = 0x1p-100;

// Integral of the distance to the corner (0, 0) over the rectangle [0, a] x [0, b]. Its three terms are positive: a
// relative error below 8 u.
double distance_to_corner(double a, double b) {
  if (std::min(a, b) < kNothing) return 0;
  return a * b * std::sqrt(a * a + b * b) / 3 + (a * a * a * std::asinh(b / a) + b * b * b * std::asinh(a / b)) / 6;
}

// The same integral of h of edge_pairs.cpp. With a >= b, the rectangle is cut along the diagonal where |dx| = |dy|:
// (4 a^2 b - 5 a b^2 - b^3 + 2 (a + b)^3 ln(1 + b/a) + 2 b^3 ln(a/b)) / 24. Without their signs the terms add up to
// less than 22 / 24, each is good to 8 u: an absolute error below 8 u.
double separation_from_corner(double first, double second) {
  const double a = std::max(first, second), b = std::min(first, second);
  if (b < kNothing) return 0;
  const double sum = a + b;
  return (b * (4 * a * a - 5 * a * b - b * b) + 2 * sum * sum * sum * std::log1p(b / a) +
          2 * b * b * b * std::log(a / b)) /
         24;
}

// U(x, y): the integral over the unit square, which the point cuts into four rectangles.
template <class FromCorner>
Dd sum_over_points(const PointView& points, const FromCorner& from_corner) {
  Sum sum;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double x = points.x[i], y = points.y[i];
    sum.add(from_corner(x, y) + from_corner(1 - x, y) + from_corner(x, 1 - y) + from_corner(1 - x, 1 - y));
  }
  return sum.value();
}

}  // namespace

double edge_l2_squared(const PointView& points, LineLaw law) {
  // Mean over two points of the square: of their distance, (2 + sqrt 2 + 5 ln(1 + sqrt 2)) / 15, and of h,
  // (24 ln 2 - 5) / 45.
  constexpr Dd kMeanDistance{0x1.0af5a726cc628p-1, 0x1.a96552e0cfbc2p-56};
  constexpr Dd kMeanSeparation{0x1.08c5e37cc548dp-2, 0x1.83715cff127f4p-56};
  const bool isotropic = law == LineLaw::isotropic;
  const Dd to_square =
      isotropic ? sum_over_points(points, distance_to_corner) : sum_over_points(points, separation_from_corner);
  const Dd to_each_other = sum_over_pairs(points, edge_pair_tiles(law).back());
  const Dd n = dd_from_integer(static_cast<std::int64_t>(points.size()));
  const Dd spread = (Dd(2.0) * to_square - to_each_other / n) / n - (isotropic ? kMeanDistance : kMeanSeparation);
  // P = distance / 2 for isotropic lines: the square's perimeter is 4, and a segment is hit twice by that measure.
  return (Dd(isotropic ? 0.25 : 0.5) * spread).value();
}

}  // namespace moire
