// Gauss-Legendre quadrature on [-1, 1].
//
// Remainder for an integrand f that is analytic and bounded by M in the Bernstein ellipse of parameter rho (foci -1, 1,
// semi-axes adding up to rho): n nodes, n >= 2, are exact to degree 2n - 1 and miss the Chebyshev term T_j, j even and
// >= 2n, by at most 2 + 2 / (j^2 - 1) <= 32 / 15, its coefficient being at most 2 M rho^-j; the sum of these is
// (64 / 15) M rho^-2n / (1 - rho^-2) (Trefethen, "Approximation Theory and Approximation Practice", 2013,
// thms 8.1, 19.3).
#pragma once

#include <cmath>
#include <cstddef>
#include <span>

namespace moire {

inline constexpr int kMaxNodes = 24;

// Nodes increasing, weights adding up to 2; both correctly rounded up to an ulp.
struct Rule {
  std::span<const double> node, weight;
};

// 1 <= n <= kMaxNodes.
Rule gauss_legendre(int n);

// Parameters of the ellipses that remainders are tried with.
inline constexpr double kEllipses[] = {1.5, 2.0, 2.5, 3.0, 4.0, 6.0, 8.0, 12.0, 20.0, 40.0};

// The remainder with n nodes per unit of M, on kEllipses[ellipse].
double gauss_remainder(std::size_t ellipse, int n);

// Parameter of the ellipse that holds every disk of radius r around a point of [-1, 1]: |z - 1| + |z + 1| <= 2 + 2 r on
// the disk, and it is rho + 1 / rho on the ellipse.
inline double ellipse_of_disk(double r) { return 1 + r + std::sqrt(r * (r + 2)); }

}  // namespace moire
