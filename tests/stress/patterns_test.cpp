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
  // Case 0, of 2^24 points, takes seconds: the heavy test has it.
  TEST_CASE("hard point sets are what their definitions say") {
    for (std::uint64_t i = 1; i < 300; ++i) {
      const Outcome outcome = run_case(stress::patterns, {1, i});
      CAPTURE(i);
      CAPTURE(outcome.fault);
      CHECK(passes(outcome));
    }
    const std::string text = stress::patterns.describe({1, 3});
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
}
