// The program's kernels against the oracle's, which share no code: closed forms against Chebyshev series.
#include <doctest/doctest.h>

#include <cmath>
#include <string>

#include "filter_list.h"
#include "oracle/kernel.h"

namespace moire {

TEST_SUITE("unit") {
  TEST_CASE("k and K of every filter are within their stated errors of the oracle's quadrature") {
    for (const std::string& text : test::filter_texts()) {
      CAPTURE(text);
      const Filter filter(parse_spec(text, "test"));
      const Kernel& product = filter.kernel();
      const oracle::Kernel truth(text);
      REQUIRE(product.radius() == static_cast<double>(truth.radius()));
      CHECK(product.k_error() < 1e-14);
      CHECK(product.K_error() < 1e-14);
      const double r = product.radius();
      for (int i = -999; i <= 999; ++i) {
        const double x = r * i / 1000;
        CAPTURE(x);
        const auto at = static_cast<long double>(x);
        const auto k = static_cast<long double>(product.k(x)), K = static_cast<long double>(product.K(x));
        CHECK(std::fabs(k - truth(at)) <= static_cast<long double>(product.k_error()));
        CHECK(std::fabs(K - truth.over(-truth.radius(), at)) <= static_cast<long double>(product.K_error()));
      }
      CHECK(product.k(r) == 0);
      CHECK(product.k(-r) == doctest::Approx(static_cast<double>(truth(-truth.radius()))).epsilon(1e-14));
      CHECK(product.K(-r) == 0);
      CHECK(product.K(r) == 1);
    }
  }
}

}  // namespace moire
