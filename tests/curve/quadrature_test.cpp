// Gauss-Legendre rules against what defines them.
#include <doctest/doctest.h>

#include <cmath>

#include "curve/quadrature.h"

using moire::gauss_legendre;

TEST_SUITE("unit") {
  TEST_CASE("n nodes integrate every Chebyshev polynomial up to degree 2n - 1, and miss the next") {
    for (int n = 1; n <= moire::kMaxNodes; ++n) {
      const moire::Rule rule = gauss_legendre(n);
      CAPTURE(n);
      for (int degree = 0; degree <= 2 * n; ++degree) {
        double sum = 0;
        for (std::size_t i = 0; i < rule.node.size(); ++i) {
          sum += rule.weight[i] * std::cos(degree * std::acos(rule.node[i]));
        }
        const double want = degree % 2 != 0 ? 0 : 2.0 / (1 - double(degree) * degree);
        CAPTURE(degree);
        // Nodes are right to half an ulp, and |T_d'| <= d^2: weighted by the rule, below d^2 2^-53; the cosine's own
        // argument adds as much.
        if (degree < 2 * n)
          CHECK(std::fabs(sum - want) <= (4 + 2.0 * degree * degree) * 0x1p-53);
        else
          CHECK(std::fabs(sum - want) > 0.5);
      }
    }
  }

  TEST_CASE("nodes increase and are symmetric, weights are positive") {
    for (int n = 1; n <= moire::kMaxNodes; ++n) {
      const moire::Rule rule = gauss_legendre(n);
      const std::size_t size = rule.node.size();
      REQUIRE(size == static_cast<std::size_t>(n));
      for (std::size_t i = 0; i < size; ++i) {
        CHECK(rule.node[i] == -rule.node[size - 1 - i]);
        CHECK(rule.weight[i] == rule.weight[size - 1 - i]);
        CHECK(rule.weight[i] > 0);
        if (i > 0) CHECK(rule.node[i] > rule.node[i - 1]);
      }
    }
  }
}
