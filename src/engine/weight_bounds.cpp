// The numbers for separable kernels come from the kernel itself; for radial ones from differences of its pieces.
#include "engine/weight_bounds.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace moire {
namespace {

struct PieceSlopes {
  double begin, end, error;  // k' at the piece's ends
  double curvature;          // bound on |k''|
};

// From differences over a grid. Cauchy's estimates bound what they miss: derivative number n is at most n! M / r^n with
// M a bound on |k| in the disks of radius r around the piece, r where the estimate is best.
PieceSlopes slopes_of(const RadialKernel& kernel, int p) {
  constexpr std::size_t kCells = 128;
  const auto i = static_cast<std::size_t>(p);
  const double begin = kernel.knots()[i], end = kernel.knots()[i + 1], h = (end - begin) / kCells;
  double second = HUGE_VAL, third = HUGE_VAL, fourth = HUGE_VAL;
  for (double r = (end - begin) / 16; r <= 4 * (end - begin); r *= 1.25) {
    const double m = kernel.k_in_disk(p, r);
    second = std::min(second, 2 * m / (r * r));
    third = std::min(third, 6 * m / (r * r * r));
    fourth = std::min(fourth, 24 * m / (r * r * r * r));
  }
  std::array<double, kCells + 1> k;
  for (std::size_t n = 0; n <= kCells; ++n) {
    k[n] = kernel.k_piece(p, std::min(begin + static_cast<double>(n) * h, end));
  }
  double largest = 0;
  for (std::size_t n = 1; n < kCells; ++n) largest = std::max(largest, std::fabs(k[n + 1] - 2 * k[n] + k[n - 1]));
  // Of a value, and of the place where it is taken: 2^-51 of the radius.
  const double noise = 2 * kernel.bounds(p).k_error + 0x1p-51 * end * kernel.bounds(p).slope;
  // Second differences err by h^2 / 12 times the fourth derivative, and every point is within h of one of their
  // middles; the slopes of parabolas at their ends by h^2 / 3 times the third.
  const double by_differences = (largest + 4 * noise) / (h * h) + h * h / 12 * fourth + h * third;
  return {(-3 * k[0] + 4 * k[1] - k[2]) / (2 * h), (3 * k[kCells] - 4 * k[kCells - 1] + k[kCells - 2]) / (2 * h),
          h * h / 3 * third + 4 * noise / h, std::min(second, by_differences) * (1 + 0x1p-40)};
}

}  // namespace

WeightBounds weight_bounds(const Kernel& kernel) {
  WeightBounds out;
  out.top = out.rim = kernel.k_max() * kernel.k_max();
  // Each knot is a line in x and one in y.
  for (int p = 0; p < kernel.pieces(); ++p)
    out.jump += 2 * (kernel.bounds(p).jump + 2 * kernel.k_error()) * kernel.k_max();
  out.slope = std::numbers::sqrt2 * kernel.k_max() * kernel.slope_max();
  out.kink = out.curvature = out.pole = HUGE_VAL;
  return out;
}

WeightBounds weight_bounds(const RadialKernel& kernel) {
  WeightBounds out;
  out.top = kernel.k_max();
  out.slope = kernel.slope_max();
  double across = 0;
  double before = 0, before_error = 0;  // k' at the knot from the left, and what that may be off by
  for (int p = 0; p < kernel.pieces(); ++p) {
    // The pieces' series meet up to their errors.
    out.jump += kernel.bounds(p).jump + 2 * kernel.k_error();
    const PieceSlopes piece = slopes_of(kernel, p);
    out.curvature = std::max(out.curvature, piece.curvature);
    const double kink = p > 0 ? std::fabs(piece.begin - before) + piece.error + before_error : 0;
    out.kink += kink;
    // Across the direction of r the second derivative is k'(r) / r, and k'(r) is k'(0), the integral of k'' and the
    // jumps of k' before r.
    if (p == 0) out.pole = std::fabs(piece.begin) + piece.error;
    if (p > 0) across += kink / kernel.knots()[static_cast<std::size_t>(p)];
    before = piece.end;
    before_error = piece.error;
  }
  out.kink += std::fabs(before) + before_error;
  out.curvature = (out.curvature + across) * (1 + 0x1p-40);
  return out;
}

double doubt(const Boundary& boundary, const WeightBounds& weight, double k_error) {
  double sum = boundary.area_error * (weight.top + k_error);
  for (const Unresolved& part : boundary.unresolved) sum += part.bound(weight) + part.area * k_error;
  return sum * (1 + 0x1p-40);
}

}  // namespace moire
