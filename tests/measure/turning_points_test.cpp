// Turning points and sign changes of functions that are known.
#include "measure/turning_points.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace moire {
namespace {

constexpr double kPi = std::numbers::pi;

TEST_SUITE("unit") {
  TEST_CASE("a Chebyshev polynomial turns at the extrema of its cosine and changes sign at the zeros") {
    for (int n = 0; n <= 40; ++n) {
      CAPTURE(n);
      const auto f = [&](double x) { return std::cos(n * std::acos(std::clamp(x / 3 - 1.0, -1.0, 1.0))); };
      const std::vector<double> turns = turning_points(f, n, 0, 6), zeros = sign_changes(f, n, 0, 6);
      REQUIRE(turns.size() == static_cast<std::size_t>(std::max(n - 1, 0)));
      REQUIRE(zeros.size() == static_cast<std::size_t>(n));
      // Near the ends the slope's own slope is n^2 and more, and so are the errors of its terms: the place stays good
      // to rounding times the support's length, of which 1e-13 leaves a factor of a hundred.
      for (std::size_t j = 0; j < turns.size(); ++j) {
        const double want = 3 - 3 * std::cos(kPi * static_cast<double>(j + 1) / n);
        CHECK(std::fabs(turns[j] - want) < 1e-13);
      }
      // acos loses half the digits near the ends, where the outermost zeros are 1/n^2 apart.
      for (std::size_t j = 0; j < zeros.size(); ++j) {
        const double want = 3 - 3 * std::cos(kPi * (2 * static_cast<double>(j) + 1) / (2 * n));
        CHECK(std::fabs(zeros[j] - want) < 1e-13);
      }
    }
  }

  TEST_CASE("two zeros that nearly touch are both found, and one that only touches is none") {
    for (const double gap : {1e-2, 1e-4, 1e-6}) {
      CAPTURE(gap);
      const auto f = [&](double x) { return (x - 0.3) * (x - 0.3) - gap * gap; };
      const std::vector<double> zeros = sign_changes(f, 2, -1, 2);
      REQUIRE(zeros.size() == 2);
      // The value's rounding, 1e-16, over its slope 2 gap.
      CHECK(std::fabs(zeros[0] - (0.3 - gap)) < 1e-15 / gap);
      CHECK(std::fabs(zeros[1] - (0.3 + gap)) < 1e-15 / gap);
    }
    CHECK(sign_changes([](double x) { return (x - 0.25) * (x - 0.25); }, 2, -1, 2).empty());
    CHECK(sign_changes([](double) { return 0.0; }, 5, -1, 2).empty());
    CHECK(turning_points([](double) { return 1.0; }, 5, -1, 2).size() <= 20);  // rounding's own, at most one a sample
  }

  TEST_CASE("a zero at an end is not inside") {
    CHECK(sign_changes([](double x) { return x; }, 1, 0, 1).empty());
    CHECK(sign_changes([](double x) { return x; }, 1, -1, 0).empty());
    CHECK(sign_changes([](double x) { return x * (x - 0.5); }, 2, 0, 1).size() == 1);
  }
}

}  // namespace
}  // namespace moire
