// Hard point sets: the family, and what its largest case is.
#include <doctest/doctest.h>

#include <string>

#include "numbers_checks.h"
#include "patterns/pattern.h"

using namespace moire;
using namespace moire::stress;

namespace moire::stress {
extern const Family patterns;
}

TEST_SUITE("unit") {
  // The first five, of 2^24 points, take seconds: the heavy test has them.
  TEST_CASE("hard point sets are what their definitions say") {
    for (std::uint64_t i = 5; i < 300; ++i) {
      const Outcome outcome = run_case(stress::patterns, {1, i});
      CAPTURE(i);
      CAPTURE(outcome.fault);
      CHECK(passes(outcome));
    }
    const std::string text = stress::patterns.describe({1, 7});
    CHECK(text.find("pattern ") == 0);
    CHECK(text.find("seed = ") != std::string::npos);
  }
}

TEST_SUITE("heavy") {
  TEST_CASE("2^24 points of zaremba are correctly rounded, their tails included") {
    const Outcome outcome = run_case(stress::patterns, {1, 0});
    CHECK(outcome.severity == kMaxSamples);
    CHECK(outcome.error == 0);
    CHECK(passes(outcome));
    // As floats they would move by half an ulp of those: why they are kept in double.
    CHECK(outcome.naive_error > 0x1p-26);
  }
  TEST_CASE("2^24 points of hammersley, n-rooks, random and jittered are what their definitions say") {
    for (std::uint64_t i = 1; i < 5; ++i) {
      const Outcome outcome = run_case(stress::patterns, {2, i});
      CAPTURE(outcome.fault);
      CHECK(outcome.severity == kMaxSamples);
      CHECK(passes(outcome));
    }
  }
}
