// Nodes by Newton's method on the Legendre polynomial in double-double, so that the rounded table is right to the ulp.
#include "curve/quadrature.h"

#include <array>
#include <cassert>
#include <cmath>
#include <iterator>

#include "core/double_double.h"

namespace moire {
namespace {

struct Tables {
  // Rule n starts at n (n - 1) / 2.
  std::array<double, kMaxNodes*(kMaxNodes + 1) / 2> node{}, weight{};
  Tables();
};

Tables::Tables() {
  for (int n = 1; n <= kMaxNodes; ++n) {
    const int first = n * (n - 1) / 2;
    for (int i = 0; i < n; ++i) {
      Dd x = -std::cos(3.141592653589793 * (i + 0.75) / (n + 0.5));
      Dd slope = 1.0;
      for (int step = 0; step < 6; ++step) {  // from 1e-3 or better, quadratic: 4 steps reach 106 bits
        Dd before = 1.0, p = x;               // P_0, P_1
        for (int k = 2; k <= n; ++k) {
          const Dd next = (Dd(2.0 * k - 1) * x * p - Dd(k - 1.0) * before) / Dd(k);
          before = p;
          p = next;
        }
        slope = Dd(n) * (before - x * p) / (Dd(1.0) - x * x);
        x = x - p / slope;
      }
      if (2 * i + 1 == n) x = 0.0;
      const auto at = static_cast<std::size_t>(first + i);
      node[at] = x.value();
      weight[at] = (Dd(2.0) / ((Dd(1.0) - x * x) * slope * slope)).value();
    }
  }
}

}  // namespace

Rule gauss_legendre(int n) {
  assert(n >= 1 && n <= kMaxNodes);
  static const Tables tables;
  const auto first = static_cast<std::size_t>(n * (n - 1) / 2);
  const auto count = static_cast<std::size_t>(n);
  return {std::span(tables.node).subspan(first, count), std::span(tables.weight).subspan(first, count)};
}

double gauss_remainder(std::size_t ellipse, int n) {
  struct Factors {
    double factor[std::size(kEllipses)][kMaxNodes + 1];
    Factors() {
      for (std::size_t i = 0; i < std::size(kEllipses); ++i) {
        const double rho = kEllipses[i];
        for (int j = 0; j <= kMaxNodes; ++j) factor[i][j] = 64.0 / 15 * std::pow(rho, -2 * j) / (1 - 1 / (rho * rho));
      }
    }
  };
  static const Factors factors;
  return factors.factor[ellipse][n];
}

}  // namespace moire
