// All families of hard cases together, as `moire stress` runs them: at another seed than everybody's, and at a hundred
// times its number of cases.
#include <doctest/doctest.h>

#include <string>

#include "stress/hunt.h"

using namespace moire::stress;

namespace {

constexpr std::uint64_t kDefault = 2000;  // cases that `moire stress` runs of a family, before its share

void check_all(std::uint64_t cases, std::uint64_t seed) {
  const auto all = hunt(families(), {.cases = cases, .seed = seed, .progress = {}, .stop = {}});
  CHECK(all.size() == families().size());
  for (const Findings& found : all) {
    const std::string name(found.family->name);
    CAPTURE(name);
    CHECK(found.cases == cases_of(*found.family, cases));
    CHECK(found.failures == 0);
    for (const Found& failed : found.failed) {
      const std::string text = found.family->describe({seed, failed.index});
      CAPTURE(failed.index);
      CAPTURE(text);
      CAPTURE(failed.outcome.fault);
      CAPTURE(failed.outcome.error);
      CAPTURE(failed.outcome.bound);
      CHECK(passes(failed.outcome));
    }
  }
}

}  // namespace

TEST_SUITE("heavy") {
  TEST_CASE("every family passes at another seed") { check_all(kDefault, 20261); }
}

TEST_SUITE("slow") {
  TEST_CASE("every family passes a hundred times its cases") { check_all(100 * kDefault, 7); }
}
