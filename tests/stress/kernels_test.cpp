// Kernels in ball arithmetic: known values, and the family.
#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "core/args.h"
#include "filters/filter.h"
#include "numbers_checks.h"
#include "stress/ball_kernel.h"

using namespace moire;
using namespace moire::stress;

namespace moire::stress {
extern const Family kernels;
}

namespace {

Filter filter_of(const std::string& text) { return Filter(parse_spec(text, "test")); }

bool holds(const Enclosed& e, long double value, long double slack = 0) {
  return std::fabs(oracle::narrow(e.value) - value) <= static_cast<long double>(e.error) + slack;
}

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("balls hold values that are known in closed form") {
    // A few 64-bit roundings of numbers below 1.
    constexpr long double kRounding = 0x1p-61L;
    const BallKernel cubic(filter_of("bspline"));
    CHECK(holds(cubic.k(0), 2 / 3.0L, kRounding));
    CHECK(holds(cubic.k(1), 1 / 6.0L, kRounding));
    CHECK(holds(cubic.K(-1), 1 / 24.0L, kRounding));
    CHECK(cubic.k(2).value == 0);
    CHECK(cubic.K(2).value == 1);
    const BallKernel mitchell(filter_of("mitchell"));
    CHECK(holds(mitchell.k(0), 8 / 9.0L, kRounding));
    CHECK(holds(mitchell.k(-1), 1 / 18.0L, kRounding));
    // The integral of exp(-2 x^2) over |x| < 3/2 and up to 1.
    const BallKernel gaussian(filter_of("gaussian:cut=cut"));
    const long double whole = std::erf(1.5L * std::numbers::sqrt2_v<long double>);
    CHECK(holds(gaussian.K(1), (1 + std::erf(std::numbers::sqrt2_v<long double>) / whole) / 2, kRounding));
    // Half the disk's radius holds a quarter.
    const BallKernel disk(filter_of("disk:radius=2"));
    CHECK(holds(disk.G(1), 1 / (8 * std::numbers::pi_v<long double>), kRounding));
    CHECK(holds(disk.q(1e-200), 1 / (8 * std::numbers::pi_v<long double>), kRounding));
  }

  TEST_CASE("every filter that needs no file has a formula, and its radius is the program's") {
    for (const std::string& text : filter_variants()) {
      const Filter filter = filter_of(text);
      CAPTURE(text);
      CHECK(BallKernel(filter).radius() == filter.radius());
    }
  }

  TEST_CASE("a kernel with a parameter that is off by an ulp or two is told from the true one") {
    const BallKernel truth(filter_of("mitchell:b=0.4,c=0.3"));
    const Filter off = filter_of("mitchell:b=0.40000000000000013,c=0.3"), right = filter_of("mitchell:b=0.4,c=0.3");
    const auto missed = [&](const Filter& filter) {
      const Enclosed k = truth.k(0);
      return static_cast<double>(oracle::abs(oracle::widen(filter.kernel().k(0)) - k.value)) - k.error >
             filter.kernel().bounds(2).k_error_at_x;
    };
    CHECK_FALSE(missed(right));
    // k(0) = 1 - b / 3 moves by 4e-17, which is below what its rounding may do; by 1e-15 it is not.
    CHECK_FALSE(missed(off));
    CHECK(missed(filter_of("mitchell:b=0.400000000000004,c=0.3")));
  }

  TEST_CASE("hard kernels keep their bounds") { check_family(kernels, 90); }
}
