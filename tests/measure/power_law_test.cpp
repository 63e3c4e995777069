// Power laws through points: synthetic ones come back, and the interval is that of a line's slope.
#include "measure/power_law.h"

#include <doctest/doctest.h>

#include <cmath>
#include <vector>

using namespace moire;

namespace {

// What rounding of a few logarithms of numbers up to 10^9 may leave of an exponent near 1.
constexpr double kRounding = 1e-13;

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("the exponent and the factor of an exact power law come back, with an interval of no width") {
    for (const double exponent : {-0.5, 0.0, 0.5, 1.0, 1.5}) {
      std::vector<PowerPoint> points;
      for (const double n : {4.0, 16.0, 100.0, 1024.0, 65536.0}) points.push_back({n, 37.5 * std::pow(n, exponent)});
      const auto law = fit_power_law(points);
      REQUIRE(law);
      CHECK(std::fabs(law->exponent - exponent) < kRounding);
      CHECK(law->factor == doctest::Approx(37.5).epsilon(kRounding));
      REQUIRE(law->interval);
      CHECK(law->interval->hi - law->interval->lo < 100 * kRounding);
      CHECK(law->n_min == 4);
      CHECK(law->n_max == 65536);
      CHECK(law->points == 5);
    }
  }

  TEST_CASE("points that scatter have the slope and the interval of the textbook") {
    // log2: (0, 0), (1, 2), (2, 1), (3, 3): slope 4/5; squares of the rest 9/5, so s = sqrt(9/5 / 2 / 5) = sqrt(0.18).
    const auto law = fit_power_law(std::vector<PowerPoint>{{1, 1}, {2, 4}, {4, 2}, {8, 8}});
    REQUIRE(law);
    CHECK(std::fabs(law->exponent - 0.8) < kRounding);
    REQUIRE(law->interval);
    // Student's t for 2 degrees of freedom in closed form: P / sqrt(2 (1 - P^2) / 4) = 0.95 / sqrt(0.04875).
    const double half = 0.95 / std::sqrt((1 - 0.95 * 0.95) / 2) * std::sqrt(0.18);
    // student_t95 is good to 1e-10.
    CHECK(law->interval->hi - 0.8 == doctest::Approx(half).epsilon(1e-9));
    CHECK(0.8 - law->interval->lo == doctest::Approx(half).epsilon(1e-9));
  }

  TEST_CASE("points without a logarithm are left out, and one count has no slope") {
    const double nan = std::nan("");
    const auto law = fit_power_law(std::vector<PowerPoint>{{0, 5}, {1, 3}, {2, nan}, {4, 0}, {nan, 2}, {9, 9}});
    REQUIRE(law);
    CHECK(law->points == 2);
    CHECK(std::fabs(law->exponent - 0.5) < kRounding);
    CHECK_FALSE(law->interval);  // a line through two points fits them whatever they are
    CHECK_FALSE(fit_power_law({}));
    CHECK_FALSE(fit_power_law(std::vector<PowerPoint>{{4, 1}}));
    CHECK_FALSE(fit_power_law(std::vector<PowerPoint>{{3, 1}, {3, 2}, {3, 5}}));
    CHECK_FALSE(fit_power_law(std::vector<PowerPoint>{{1e15, 1}, {std::nextafter(1e15, 2e15), 2}}));
  }
}
