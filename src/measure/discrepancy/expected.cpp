// Means of squared discrepancies over all draws of random, jittered and N-rooks points.
#include "measure/discrepancy/expected.h"

#include <cmath>
#include <numbers>

namespace moire {
namespace {

// A line hits the square and separates two points at a chance P, which for both laws is homogeneous of degree 1 in the
// points' difference: half the distance for isotropic lines, h for printed ones, with u >= v the larger and the smaller
// difference of coordinates h = ((u - v) + (u + v) ln(1 + v / u)) / 2.
//
// E[D^2] over lines is (mean of P over pairs of one point of the set and one of the square) less half the mean of P
// over all N^2 ordered pairs of points of the set, less half its mean over pairs of the square.

// Mean of P over two uniform points of the square: (2 + sqrt 2 + 5 ln(1 + sqrt 2)) / 30, and
// (24 ln 2 - 5) / 45.
double separate_in_square(LineLaw law) {
  return law == LineLaw::isotropic ? 0.52140543316472067833 / 2 : 0.25856738518752638724;
}

// (e - ln(1 + e)) / e^2 for 0 < e <= 1 without its cancellation: 1/2 - e/3 + e^2/4 - ... where e is small.
double log_rest(double e) {
  if (e > 0.25) return (e - std::log1p(e)) / (e * e);
  double sum = 0;
  for (int k = 31; k >= 2; --k) sum = 1.0 / k - e * sum;  // the first term left out is below 4^-30 / 32
  return sum;
}

// Mean of P over two uniform points of a rectangle with sides 1 and e, 0 < e <= 1; e = 1 is the square. Both are
// ordered so that no terms in 1 / e are left to cancel.
double separate_in_rectangle(double e, LineLaw law) {
  if (law == LineLaw::isotropic) {
    // Half the mean distance (Santalo, "Integral Geometry and Geometric Probability", 1976).
    const double d = std::sqrt(1 + e * e);
    return (d * (3 - e * e) + e * e * e - 1 / (1 + d) + 2.5 * (e * e * std::asinh(1 / e) + std::asinh(e) / e)) / 30;
  }
  // Four times the integral of (1 - u) (1 - v) h(u, e v) over the unit square, along rays of constant e v / u:
  // (6 (1 + e)^5 ln(1 + e) - 6 e^4 (e + 5) ln e + e^5 - 21 e^4 - 47 e^3 + 33 e^2 - 6 e) / (360 e^2).
  const double l = std::log1p(e);
  const double logs = 30 * (l / e) - 6 * log_rest(e) + l * (60 + e * (60 + e * (30 + e * 6)));
  return (logs - 6 * e * e * (e + 5) * std::log(e) + 33 + e * (-47 + e * (-21 + e))) / 360;
}

}  // namespace

double expected_star_l2_squared_random(std::int64_t n, int dims) {
  return (dims == 2 ? 5.0 / 36 : 19.0 / 216) / static_cast<double>(n);
}

// The share of a cell that a box covers is a product of one share per axis; s = sqrt N shares have mean-square sum
// (s - 1/3) / 2 over boxes, so sum q^2 is ((3 s - 1) / 6)^2, times 1/3 for a random time.
double expected_star_l2_squared_jittered(std::int64_t n, int dims) {
  const auto count = static_cast<double>(n);
  const double s = std::sqrt(count);
  return (dims == 2 ? (6 * s - 1) / 36 : (9 * count + 12 * s - 2) / 216) / (count * count);
}

// Two points are in different strata of each axis, and the axes are independent: E[(1 - max)] = (2 - 1/N) / 6 an axis.
double expected_star_l2_squared_n_rooks(std::int64_t n) {
  const double e = 1 / static_cast<double>(n);
  return e * (1 + e * (5 - e)) / 36;
}

double expected_edge_l2_squared_random(std::int64_t n, LineLaw law) {
  return separate_in_square(law) / (2 * static_cast<double>(n));
}

// Two points of one cell would be separated sqrt N times less often than two of the square; each point is alone in its
// cell.
double expected_edge_l2_squared_jittered(std::int64_t n, LineLaw law) {
  return expected_edge_l2_squared_random(n, law) / std::sqrt(static_cast<double>(n));
}

// Two uniform points share their stratum in x, in y or in both at chances 1/N, 1/N and 1/N^2; a pair of N-rooks is what
// remains of them. With S the mean of P in the square and R in a rectangle of 1 by 1/N, N-rooks' pairs have the mean
// (S - 2 R / N + S / N^3) / (1 - 1/N)^2.
double expected_edge_l2_squared_n_rooks(std::int64_t n, LineLaw law) {
  if (n == 1) return expected_edge_l2_squared_random(1, law);
  const auto count = static_cast<double>(n);
  const double square = separate_in_square(law), rectangle = separate_in_rectangle(1 / count, law);
  return (2 * rectangle - square - square / (count * count)) / (2 * (count - 1));
}

double expected_disk_l2_squared_random(std::int64_t n, std::optional<double> radius) {
  constexpr double kPi = std::numbers::pi;
  const double area = radius ? kPi * *radius * *radius : 0;
  return (radius ? area * (1 - area) : kPi / 12 - kPi * kPi / 80) / static_cast<double>(n);
}

}  // namespace moire
