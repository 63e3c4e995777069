// Quantiles of chi-square against closed forms.
#include "measure/chi_square.h"

#include <doctest/doctest.h>

#include <cmath>
#include <initializer_list>

namespace {

// P(X > x) for an even number of degrees of freedom: P(Poisson(x / 2) < degrees / 2) (Abramowitz, Stegun, 1964,
// 26.4.21), summed downwards from the last term until terms no longer count.
long double upper_tail(double x, long degrees) {
  const long double mean = 0.5L * static_cast<long double>(x);
  const long last = degrees / 2 - 1;
  const auto k = static_cast<long double>(last);
  long double term = std::exp(k * std::log(mean) - mean - std::lgamma(k + 1)), sum = 0;
  for (long i = last; i >= 0 && term > 1e-25L; --i) {
    sum += term;
    term *= static_cast<long double>(i) / mean;
  }
  return sum;
}

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("chi-square's quantiles have their probabilities, at any even number of degrees") {
    for (const long degrees : {2L, 4L, 6L, 22L, 24L, 26L, 100L, 5000L, 100000L, 1999998L, 2000002L, 50000000L}) {
      CAPTURE(degrees);
      const moire::Interval q = moire::chi_square95(static_cast<double>(degrees));
      // A relative error e of the quantile changes the probability by e x density(x), at most
      // e sqrt(degrees) / 2 * 0.12 (beyond some 10 degrees, the normal limit); with e = 1e-10 that is below 5e-8 at the
      // largest number here.
      const double tolerance = 1e-10 * (0.1 + 0.06 * std::sqrt(static_cast<double>(degrees)));
      CHECK(std::fabs(static_cast<double>(upper_tail(q.lo, degrees) - 0.975L)) < tolerance);
      CHECK(std::fabs(static_cast<double>(upper_tail(q.hi, degrees) - 0.025L)) < tolerance);
    }
  }

  TEST_CASE("one degree of freedom is the square of a normal number, two are an exponential one") {
    const moire::Interval one = moire::chi_square95(1), two = moire::chi_square95(2);
    // P(X <= x) = erf(sqrt(x / 2)).
    CHECK(std::fabs(std::erf(std::sqrt(one.lo / 2)) - 0.025) < 1e-12);
    CHECK(std::fabs(std::erf(std::sqrt(one.hi / 2)) - 0.975) < 1e-12);
    CHECK(std::fabs(two.lo + 2 * std::log(0.975)) < 1e-10 * two.lo);
    CHECK(std::fabs(two.hi + 2 * std::log(0.025)) < 1e-10 * two.hi);
  }

  TEST_CASE("fractions of a degree lie between their neighbours") {
    double lo = 0, hi = 0;
    for (double degrees = 0.5; degrees < 60; degrees *= 1.05) {
      const moire::Interval q = moire::chi_square95(degrees);
      CHECK(q.lo > lo);
      CHECK(q.hi > hi);
      lo = q.lo;
      hi = q.hi;
    }
  }

  TEST_CASE("the interval of a mean power holds the mean and shrinks as degrees grow") {
    double width = 1e9;
    for (const double degrees : {2.0, 8.0, 100.0, 1e6, 1e9}) {
      const moire::Interval band = moire::power_interval(3, degrees);
      CHECK(band.lo < 3);
      CHECK(band.hi > 3);
      CHECK(band.hi - band.lo < width);
      width = band.hi - band.lo;
    }
    CHECK(moire::power_interval(0, 10).hi == 0);
  }
}
