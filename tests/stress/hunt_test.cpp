// The hunt itself, on families that were made up: what it keeps, what fails, and that threads cannot change it.
#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/parallel.h"
#include "stress/chance.h"
#include "stress/hunt.h"

using namespace moire::stress;

namespace {

std::string number_of(CaseKey key) { return std::to_string(key.index); }

// Errors 0, 1, 2, ..., 9, 0, 1, ... times 1e-16 of a value of 2, all within the bound; severity 1 or 100.
Outcome saw(CaseKey key) {
  Outcome outcome;
  outcome.error = static_cast<double>(key.index % 10) * 1e-16;
  outcome.wanted = outcome.computed = 2;
  outcome.bound = 1e-15;
  outcome.severity = key.index % 2 == 0 ? 1 : 100;
  outcome.naive_error = key.index == 3 ? 0.5 : std::numeric_limits<double>::quiet_NaN();
  return outcome;
}

// Fails in case 5 by its error, in 7 by a fault, in 8 by an exception, in 9 by NaN.
Outcome broken(CaseKey key) {
  Outcome outcome = saw(key);
  if (key.index == 5) outcome.error = 2e-15;
  if (key.index == 7) outcome.fault = "a coordinate of 1.0";
  if (key.index == 8) throw std::runtime_error("no such luck");
  if (key.index == 9) outcome.error = std::numeric_limits<double>::quiet_NaN();
  return outcome;
}

Outcome random_errors(CaseKey key) {
  Chance chance("random", key);
  Outcome outcome;
  outcome.error = chance.unit();
  outcome.bound = 1;
  outcome.severity = chance.decades(1e-3, 1e3);
  outcome.wanted = chance.between(-1, 1);
  return outcome;
}

Family family_of(Outcome (*run)(CaseKey), double share = 1) {
  return {"toy", "cases made up", "a number", "none", "made up", share, run, number_of};
}

Findings found(const Family& family, std::uint64_t cases) {
  return hunt(std::vector<Family>{family}, {.cases = cases, .progress = {}, .stop = {}}).front();
}

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("the hunt keeps the worst case, the first of equals, and the largest error of each severity") {
    const Findings findings = found(family_of(saw), 100);
    CHECK(findings.cases == 100);
    CHECK(findings.failures == 0);
    CHECK(findings.largest.index == 9);
    CHECK(findings.relative.index == 9);
    CHECK(findings.closest.index == 9);
    CHECK(findings.naive_error == 0.5);
    REQUIRE(findings.growth.size() == 2);
    CHECK(findings.growth[0].severity_lo == 1);
    CHECK(findings.growth[0].cases == 50);
    CHECK(findings.growth[0].error == 8e-16);
    CHECK(std::isnan(findings.growth[0].naive_error));
    CHECK(findings.growth[1].severity_lo == 100);
    CHECK(findings.growth[1].error == 9e-16);
    CHECK(findings.growth[1].naive_error == 0.5);
  }

  TEST_CASE("an error beyond its bound, a fault, an exception and NaN all fail, and each is kept") {
    const Findings findings = found(family_of(broken), 20);
    CHECK(findings.failures == 4);
    REQUIRE(findings.failed.size() == 4);
    CHECK(findings.failed[0].index == 5);
    CHECK(findings.failed[1].outcome.fault == "a coordinate of 1.0");
    CHECK(findings.failed[2].outcome.fault == "no such luck");
    CHECK(findings.failed[3].index == 9);
    CHECK_FALSE(passes(findings.closest.outcome));
  }

  TEST_CASE("what the oracle may err by is granted, and no more") {
    Outcome outcome;
    outcome.error = 3;
    outcome.bound = 2;
    outcome.oracle_error = 1;
    CHECK(passes(outcome));
    outcome.error = std::nextafter(3.0, 4.0);
    CHECK_FALSE(passes(outcome));
  }

  TEST_CASE("the number of threads changes nothing") {
    const auto with_threads = [](int threads) {
      const moire::ThreadLimit limit(threads);
      return found(family_of(random_errors), 1000);
    };
    const Findings one = with_threads(1), three = with_threads(3);
    CHECK(one.largest.index == three.largest.index);
    CHECK(one.relative.index == three.relative.index);
    CHECK(one.closest.index == three.closest.index);
    REQUIRE(one.growth.size() == three.growth.size());
    for (std::size_t i = 0; i < one.growth.size(); ++i) CHECK(one.growth[i].error == three.growth[i].error);
  }

  TEST_CASE("a family that costs much runs its share of the cases, one at least") {
    CHECK(cases_of(family_of(saw, 0.25), 100) == 25);
    CHECK(cases_of(family_of(saw, 1e-6), 100) == 1);
    CHECK(found(family_of(saw, 0.25), 100).cases == 25);
  }

  TEST_CASE("a hunt that is stopped says how far it came") {
    const std::vector<Family> two = {family_of(saw), family_of(saw)};
    CHECK(hunt(two, {.cases = 100, .progress = {}, .stop = [] { return true; }}).size() == 1);
    std::uint64_t done = 0, due = 0;
    hunt(two, {.cases = 100,
               .progress =
                   [&](std::uint64_t so_far, std::uint64_t all) {
                     done = so_far;
                     due = all;
                   },
               .stop = {}});
    CHECK(done == 200);
    CHECK(due == 200);
  }

  TEST_CASE("choices depend on seed, family and case, and stay in their ranges") {
    std::set<std::uint64_t> first;
    for (const std::uint64_t seed : {1, 2}) {
      for (const char* name : {"edges", "disks"}) {
        for (std::uint64_t index = 0; index < 100; ++index) first.insert(Chance(name, {seed, index}).bits());
      }
    }
    CHECK(first.size() == 400);
    Chance chance("edges", {1, 2});
    for (int i = 0; i < 1000; ++i) {
      const double unit = chance.unit(), decade = chance.decades(1e-3, 1e3);
      CHECK(unit >= 0);
      CHECK(unit < 1);
      CHECK(decade >= 1e-3 * (1 - 1e-15));  // exp and log round
      CHECK(decade <= 1e3 * (1 + 1e-15));
      CHECK(chance.below(7) < 7);
      CHECK(std::abs(chance.sign()) == 1);
    }
  }
}
