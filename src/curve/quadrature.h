// Gauss-Legendre quadrature on [-1, 1].
//
// Remainder for an integrand f that is analytic and bounded by M in the Bernstein ellipse of parameter rho (foci -1, 1,
// semi-axes adding up to rho): n nodes, n >= 2, are exact to degree 2n - 1 and miss the Chebyshev term T_j, j even and
// >= 2n, by at most 2 + 2 / (j^2 - 1) <= 32 / 15, its coefficient being at most 2 M rho^-j; the sum of these is
// (64 / 15) M rho^-2n / (1 - rho^-2) (Trefethen, "Approximation Theory and Approximation Practice", 2013,
// thms 8.1, 19.3).
#pragma once

#include <span>

namespace moire {

inline constexpr int kMaxNodes = 24;

// Nodes increasing, weights adding up to 2; both correctly rounded up to an ulp.
struct Rule {
  std::span<const double> node, weight;
};

// 1 <= n <= kMaxNodes.
Rule gauss_legendre(int n);

}  // namespace moire
