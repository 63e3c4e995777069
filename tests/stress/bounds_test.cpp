// The printed bounds are honest: over hard and ordinary scenes, still and moving, and all filters, no exact value is
// further from the oracle's than its bound says.
#include <doctest/doctest.h>

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/parallel.h"
#include "engine/random_scenes.h"
#include "stress/exact_case.h"
#include "stress/hunt.h"

namespace moire::stress {

extern const Family edges, disks, boards;

namespace {

// Scenes as images have them, not made to hurt.
ExactCase ordinary_case(CaseKey key) {
  Chance chance("ordinary", key);
  Draw draw(chance.bits());
  const FilterPtr filter = pick_filter(chance);
  const double reach = filter->filter.radius();
  // A board's squares are what the oracle's time is spent on.
  const double squares = filter->is_box ? 60 : filter->filter.is_radial() ? 4 : 9;
  const std::uint64_t kind = key.index % 3;
  RandomCase c = kind == 0   ? random_edge(draw, reach)
                 : kind == 1 ? random_disk(draw, reach)
                             : random_board(draw, reach, std::max(squares, 3 * reach));
  return {std::move(c.image), c.pixel, filter};
}

const Family kOrdinary = {.name = "ordinary",
                          .title = "Random edges, disks and boards",
                          .quantity = "exact value of a pixel under any filter",
                          .severity = "none",
                          .claim = "the printed bound",
                          .run = [](CaseKey key) { return run(ordinary_case(key)); },
                          .describe = [](CaseKey key) { return describe(ordinary_case(key)); }};

struct Sweep {
  std::uint64_t cases = 0, failures = 0;
  std::uint64_t open = 0;     // the true value is neither 0 nor 1
  std::uint64_t telling = 0;  // the oracle knows the value better than the bound claims
  std::uint64_t blind = 0;    // it knows it a thousand times worse
  std::uint64_t sharp = 0;    // the same, and the bound is what off-horizon values promise, or less
  double largest_share = 0;   // of an error, what the oracle may err by taken off, in its bound
  std::string failed;         // the first ones

  void add(const Family& family, CaseKey key, const Outcome& outcome) {
    ++cases;
    open += outcome.wanted != 0 && outcome.wanted != 1;
    telling += outcome.oracle_error <= outcome.bound;
    sharp += outcome.oracle_error <= outcome.bound && outcome.bound <= 1e-12;
    blind += outcome.bound > 0 && outcome.oracle_error > 1000 * outcome.bound;
    if (outcome.bound > 0)
      largest_share = std::max(largest_share, (outcome.error - outcome.oracle_error) / outcome.bound);
    if (passes(outcome)) return;
    if (++failures <= 5) failed += family.describe(key) + "\n";
  }
};

// `cases` of each family, from that seed on.
Sweep sweep(std::span<const Family* const> families, std::uint64_t seed, std::uint64_t cases) {
  constexpr std::uint64_t kBatch = 1 << 14;
  Sweep all;
  std::vector<Outcome> outcomes(kBatch);
  for (const Family* family : families) {
    for (std::uint64_t first = 0; first < cases; first += kBatch) {
      const std::uint64_t count = std::min(kBatch, cases - first);
      parallel_for(
          count,
          [&](std::size_t i) {
            outcomes[i] = run_case(*family, {seed, first + i});
          },
          64);
      for (std::uint64_t i = 0; i < count; ++i) all.add(*family, {seed, first + i}, outcomes[i]);
    }
  }
  return all;
}

void check_sweep(std::uint64_t seed, std::uint64_t cases) {
  const Family* const all[] = {&edges, &disks, &boards, &kOrdinary};
  const Sweep s = sweep(all, seed, cases);
  MESSAGE(s.cases << " cases, " << s.open << " neither 0 nor 1, " << s.telling
                  << " with an oracle better than the bound, " << s.sharp
                  << " of them with a bound of 1e-12 or less; errors up to " << s.largest_share << " of their bounds");
  INFO(s.failed);
  CHECK(s.failures == 0);
  CHECK(s.cases == 4 * cases);
  // What makes the sweep worth something: most cases have something to get wrong, and the oracle knows better.
  CHECK(s.open > s.cases / 2);
  CHECK(s.telling > s.cases * 9 / 10);
  // All but those at a horizon, a ninth of the boards and those without end; boards are a quarter of the cases.
  CHECK(s.sharp > s.cases * 17 / 20);
  CHECK(s.blind <= s.cases / 1000);  // circles that only just touch a wide kernel's window, worth next to nothing
}

}  // namespace

TEST_SUITE("heavy") {
  TEST_CASE("no bound is exceeded in 10,000 cases over hard and ordinary scenes under all filters") {
    check_sweep(11, 2600);
  }
}

TEST_SUITE("slow") {
  TEST_CASE("no bound is exceeded in a million cases over hard and ordinary scenes under all filters") {
    check_sweep(12, 250000);
  }
}

}  // namespace moire::stress
