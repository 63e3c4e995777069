// The family of checkerboards.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "oracle/coverage.h"
#include "stress/exact_checks.h"
#include "stress/naive.h"
#include "stress/scenes.h"

namespace moire::stress {

extern const Family boards;

TEST_SUITE("unit") {
  TEST_CASE("hard boards are within their bounds of the oracle") { check_passes(boards, 3, 450); }

  TEST_CASE("a described board is the same case again, down to the bits") { check_can_be_rerun(boards, 4, 72); }

  TEST_CASE("3000 hard boards meet every filter of the catalogue") { check_meets_all_filters(boards, 1, 3000); }

  TEST_CASE("squares of the pixel's size are worth 1 and 0, and of half its size one half") {
    for (const double scale : {1.0, 2.0}) {
      const std::vector<double> h{scale, 0, 0, 0, scale, 0, 0, 0, 1};
      for (const Pixel p : {Pixel{0, 0}, Pixel{1, 0}, Pixel{3, 3}}) {
        const Outcome outcome = run({scenes::board(h, {-8, 8, -8, 8}), p, checked_filter("box")});
        CHECK(passes(outcome));
        CHECK(outcome.wanted == (scale == 2 ? 0.5 : (p.x + p.y) % 2 == 0 ? 1 : 0));
      }
    }
  }

  TEST_CASE("textbook coverage of a board is right for an easy one") {
    const oracle::Board board{{0.7, 0.1, 0, -0.2, 0.9, 0, 1e-3, 2e-3, 1}, {-8, 8, -8, 8}};
    CHECK(naive_coverage(board, {2, 3}, 1) ==
          doctest::Approx(static_cast<double>(oracle::coverage(board, {2, 3}, 1).value)).epsilon(1e-12));
  }
}

}  // namespace moire::stress
