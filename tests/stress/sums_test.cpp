// Hard sums: the exact accumulator on known numbers, and the family.
#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "core/sum.h"
#include "numbers_checks.h"
#include "stress/chance.h"
#include "stress/exact_sum.h"
#include "stress/hard_sequence.h"
#include "stress/long_sum.h"
#include "stress/worst.h"

using namespace moire;
using namespace moire::stress;

namespace moire::stress {
extern const Family sums;
}

TEST_SUITE("unit") {
  TEST_CASE("the exact accumulator holds the smallest and the largest doubles and their products together") {
    constexpr double kLargest = std::numeric_limits<double>::max(), kLeast = std::numeric_limits<double>::denorm_min();
    ExactSum sum;
    sum.add_product(kLargest, kLargest);
    sum.add(kLeast);
    sum.add_product(kLeast, -kLeast);
    sum.add_product(-kLargest, kLargest);
    sum.add(-kLeast);
    // What is left is -2^-2148.
    CHECK(sum.value() == -ExactSum::power_of_two(-2148));
    sum.add_product(kLeast, kLeast);
    CHECK(sum.value() == 0);
    for (const double v : {1e16, 1.0, -1e16, -3.0}) sum.add(v);
    CHECK(static_cast<double>(sum.value()) == -2);
    CHECK(static_cast<double>(sum.distance_to(-1.5)) == 0.5);
  }

  TEST_CASE("hard sequences have the condition that is asked for") {
    for (const int bits : {0, 20, 60, 130}) {
      Chance chance("test", {1, static_cast<std::uint64_t>(bits)});
      ExactSum sum;
      double absolute = 0;
      for (const double v : hard_sequence(chance, 100, bits)) {
        sum.add(v);
        absolute += std::fabs(v);
      }
      // The terms before the last ones have the size 2^bits, and the last is of the size of 1.
      const double condition = absolute / std::fabs(static_cast<double>(sum.value()));
      CAPTURE(bits);
      CHECK(condition >= std::ldexp(1, bits - 4));
    }
  }

  TEST_CASE("a sum that lost its compensation is caught") {
    // Sixteen ones and sixteen times 2^-50, a quarter of an ulp of 16 each: plain addition keeps 16.
    double plain = 0;
    Sum sum;
    ExactSum exact;
    for (int i = 0; i < 32; ++i) {
      const double v = i < 16 ? 1 : 0x1p-50;
      plain += v;
      sum.add(v);
      exact.add(v);
    }
    const auto judged = [&](double computed) {
      Measured m;
      m.computed = computed;
      m.error = static_cast<double>(exact.distance_to(computed));
      m.bound = 0x1p-53 * computed + 32.0 * 32 * 0x1p-106 * 17;
      Worst worst;
      worst.see(m);
      return passes(worst.outcome(1));
    };
    CHECK(judged(sum.value()));
    CHECK_FALSE(judged(std::nextafter(sum.value(), 100)));
    CHECK_FALSE(judged(plain));
  }

  TEST_CASE("hard sums keep their bounds") { check_family(sums, 300); }

  TEST_CASE("NaN is caught, whatever the error says") {
    Worst worst;
    Measured m;
    m.computed = std::numeric_limits<double>::quiet_NaN();
    m.bound = 1;
    worst.see(m);
    CHECK_FALSE(passes(worst.outcome(1)));
  }

  TEST_CASE("a bound that is NaN is caught, even where nothing is wrong with the value and worse errors follow") {
    constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
    for (double Measured::*const field : {&Measured::bound, &Measured::oracle_error, &Measured::error}) {
      Worst worst;
      Measured m;
      m.bound = 1;
      m.*field = kNone;
      worst.see({.quantity = "before", .error = 0.5, .bound = 1});
      worst.see(m);
      worst.see({.quantity = "after", .error = 0.9, .bound = 1});
      CHECK_FALSE(passes(worst.outcome(1)));
    }
  }

  TEST_CASE("the long sum is rounded once, and adding from left to right is not") {
    const Outcome outcome = long_sum(1 << 21, {1, 0});
    CHECK(passes(outcome));
    CHECK(outcome.bound <= 0x1p-53 * outcome.computed);
    CHECK(outcome.naive_error > outcome.bound);
  }
}

TEST_SUITE("slow") {
  TEST_CASE("the sum of 10^9 terms is rounded once") {
    const Outcome outcome = long_sum(1'000'000'000, {1, 0});
    CHECK(passes(outcome));
    CHECK(outcome.bound <= 0x1p-53 * outcome.computed);
    CHECK(outcome.naive_error > outcome.bound);
  }
}
