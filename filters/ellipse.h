// Bernstein ellipses of a kernel's pieces, and how large the functions that kernels are made of get on them.
//
// Trefethen, "Approximation Theory and Approximation Practice", 2013, chapter 8: a function that is bounded on the
// ellipse has a Chebyshev series that falls off geometrically.
#pragma once

#include <cmath>
#include <numbers>
#include <vector>

namespace moire {

// The ellipse of parameter rho > 1 around the piece from a to b, its foci: where it lies and its semi-axes.
struct Ellipse {
  double mid, real, imaginary;

  Ellipse(double a, double b, double rho)
      : mid((a + b) / 2), real((b - a) / 4 * (rho + 1 / rho)), imaginary((b - a) / 4 * (rho - 1 / rho)) {}
  // Around knots[piece] and the knot after it, each divided by `unit`.
  Ellipse(const std::vector<double>& knots, int piece, double unit, double rho)
      : Ellipse(knots[static_cast<std::size_t>(piece)] / unit, knots[static_cast<std::size_t>(piece) + 1] / unit, rho) {
  }

  // Bound on |z|.
  double reach() const { return std::fabs(mid) + real; }
};

// Bound on |cos(pi z)| and |sin(pi z)| for |Im z| <= height.
inline double cos_pi_bound(double height) { return std::cosh(std::numbers::pi * height); }

// Bound on |sinc(z)| for |Im z| <= height: sinc(z) is the mean of exp(2 pi i t z) over |t| <= 1/2.
inline double sinc_bound(double height) { return std::exp(std::numbers::pi * height); }

}  // namespace moire
