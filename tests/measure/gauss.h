// Gauss-Legendre quadrature for tests: not the product's.
#pragma once

#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

namespace moire::test {

// Nodes in (0, 1) and weights of Gauss-Legendre quadrature: Newton's method on the three-term recurrence.
inline std::vector<std::pair<double, double>> gauss(int n) {
  std::vector<std::pair<double, double>> rule;
  for (int i = 0; i < n; ++i) {
    double x = std::cos(std::numbers::pi * (i + 0.75) / (n + 0.5)), slope = 0;
    for (int step = 0; step < 8; ++step) {
      double before = 1, now = x;
      for (int k = 2; k <= n; ++k) {
        const double next = ((2 * k - 1) * x * now - (k - 1) * before) / k;
        before = now;
        now = next;
      }
      slope = n * (x * now - before) / (x * x - 1);
      x -= now / slope;
    }
    rule.emplace_back((1 + x) / 2, 1 / ((1 - x * x) * slope * slope));
  }
  return rule;
}

}  // namespace moire::test
