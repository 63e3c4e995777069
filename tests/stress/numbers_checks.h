// What every family of numbers must do, whatever it computes.
#pragma once

#include <doctest/doctest.h>

#include <string>

#include "stress/family.h"
#include "stress/hunt.h"

namespace moire::stress {

// `count` cases pass, each the same when it runs again, and each is described; a value moved by twice what it may err
// is caught.
inline void check_family(const Family& family, std::uint64_t count, std::uint64_t seed = 1) {
  for (std::uint64_t i = 0; i < count; ++i) {
    const CaseKey key{seed, i};
    Outcome outcome = run_case(family, key);
    CAPTURE(i);
    if (!passes(outcome)) {
      CAPTURE(outcome.fault);
      CAPTURE(outcome.error);
      CAPTURE(outcome.bound);
      CAPTURE(family.describe(key));
      CHECK(passes(outcome));
    }
    CHECK(outcome.severity > 0);
    if (i % 64 != 1) continue;
    const Outcome again = run_case(family, key);
    CHECK(again.computed == outcome.computed);
    CHECK(again.error == outcome.error);
    CHECK_FALSE(family.describe(key).empty());
    outcome.error += 2 * (outcome.bound + outcome.oracle_error) + 0x1p-1000;
    CHECK_FALSE(passes(outcome));
  }
}

}  // namespace moire::stress
