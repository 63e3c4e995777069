// The F distribution against closed forms, other distributions and quadrature.
#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "measure/chi_square.h"
#include "measure/f_distribution.h"
#include "measure/statistics.h"
#include "noise_images.h"

namespace moire {
namespace {

// 1e-10 throughout: the header's bound.
constexpr double kEpsilon = 1e-10;

TEST_SUITE("unit") {
  TEST_CASE("with two upper degrees of freedom F survives as a power, down to 1e-200") {
    for (const double lower : {1.0, 2.0, 7.5, 62.0, 1000.0, 2e6}) {
      for (const double x : {1e-12, 0.01, 0.7, 1.0, 3.0, 20.0, 400.0}) {
        CAPTURE(lower);
        CAPTURE(x);
        const double want = std::exp(-lower / 2 * std::log1p(2 * x / lower));
        if (want > 1e-200) CHECK(relative(f_survival(x, 2, lower), want) <= kEpsilon);
      }
    }
  }

  TEST_CASE("with one upper degree of freedom F is the square of Student's t") {
    for (const int lower : {1, 2, 3, 10, 31, 120, 499}) {
      CAPTURE(lower);
      const double t = student_t95(lower);
      CHECK(relative(f_survival(t * t, 1, lower), 0.05) <= 1e-8);  // t is known to 1e-10, at a steep slope
    }
  }

  TEST_CASE("F of swapped degrees of freedom is the reciprocal") {
    for (const double upper : {0.7, 1.0, 5.0, 80.0, 3000.0}) {
      for (const double lower : {1.0, 2.3, 40.0, 50000.0}) {
        CAPTURE(upper);
        CAPTURE(lower);
        for (const double x : {0.1, 0.9, 1.3, 6.0})
          CHECK(relative(f_survival(x, upper, lower) + f_survival(1 / x, lower, upper), 1) <= kEpsilon);
        const Interval there = f95(upper, lower), back = f95(lower, upper);
        CHECK(relative(there.lo * back.hi, 1) <= 1e-9);
        CHECK(relative(there.hi * back.lo, 1) <= 1e-9);  // where the density is small, 1e-10 of P is more of x
        CHECK(relative(f_survival(there.lo, upper, lower), 0.975) <= kEpsilon);
        CHECK(relative(f_survival(there.hi, upper, lower), 0.025) <= kEpsilon);
      }
    }
  }

  TEST_CASE("the incomplete beta function agrees with its polynomials for whole exponents") {
    // I_x(a, b) is the probability of a or more successes in a + b - 1 trials.
    for (const double x : {1e-5, 0.03, 0.2, 0.5, 0.77, 0.999}) {
      for (int a = 1; a <= 6; ++a) {
        for (int b = 1; b <= 6; ++b) {
          const int n = a + b - 1;
          double want = 0;
          for (int k = a; k <= n; ++k)
            want += std::round(std::tgamma(n + 1) / std::tgamma(k + 1) / std::tgamma(n - k + 1)) * std::pow(x, k) *
                    std::pow(1 - x, n - k);
          CAPTURE(x);
          CAPTURE(a);
          CAPTURE(b);
          CHECK(relative(incomplete_beta(a, b, x), want) <= kEpsilon);
        }
      }
    }
    CHECK(incomplete_beta(2, 3, 0) == 0);
    CHECK(incomplete_beta(2, 3, 1) == 1);
    CHECK(f_survival(0, 3, 5) == 1);
    CHECK(f_survival(std::numeric_limits<double>::infinity(), 3, 5) == 0);
  }

  TEST_CASE("over very many lower degrees of freedom F is chi-square over its degrees") {
    // The difference of the quantiles is of the order of upper / lower.
    for (const double upper : {1.0, 3.0, 50.0}) {
      const Interval chi = chi_square95(upper), f = f95(upper, 1e9);
      CHECK(relative(f.lo, chi.lo / upper) <= 1e-6);
      CHECK(relative(f.hi, chi.hi / upper) <= 1e-6);
    }
  }
}

}  // namespace
}  // namespace moire
