// Exact values against the oracle on random pixels that the boundary crosses.
#include <doctest/doctest.h>

#include "engine/exact_compare.h"
#include "engine/random_scenes.h"

namespace moire {
namespace {

constexpr double kBoxTolerance = 1e-13;   // what moire promises for the box
constexpr double kWideTolerance = 1e-12;  // and for every other filter

// Squares in a window: enough for corners, rims and rows of squares; the oracle's time grows with them.
constexpr double kCells = 30;

// Median bound of edges and disks: as their tolerances. Nothing is promised for boards, whose bounds grow with the
// squares in a window and with the homography's condition; theirs only must not become meaningless.
constexpr double kBoardBound = 1e-10;

template <class Next>
void compare_box(double median_bound, const Next& next) {
  ExactComparison compare("box", kBoxTolerance);
  for (int i = 0; i < 10000; ++i) {
    const RandomCase c = next(compare.radius());
    compare(c.image, c.pixel);
  }
  MESSAGE(compare.summary());
  CHECK(compare.partial() > 9000);  // the generators aim at the boundary: the cases are no flat pixels
  CHECK(compare.median_bound() < median_bound);
}

template <class Next>
void compare_wide(int pixels, double median_bound, const Next& next) {
  for (const std::string& filter : wide_filters()) {
    ExactComparison compare(filter, kWideTolerance);
    for (int i = 0; i < pixels; ++i) {
      const RandomCase c = next(compare.radius());
      compare(c.image, c.pixel);
    }
    MESSAGE(compare.summary());
    CHECK(compare.median_bound() < median_bound);
  }
}

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("a camera's stored homography is that of the contract of scene files") {
    Draw draw(10);
    for (int i = 0; i < 1000; ++i) {
      const scenes::Camera c{draw.log_uniform(10, 2000),  {draw.uniform(-1000, 1000), draw.uniform(-1000, 1000)},
                             draw.log_uniform(0.01, 100), draw.uniform(-89, 89),
                             draw.uniform(-180, 180),     draw.uniform(-180, 180)};
      const oracle::Board board = oracle::board_of(scenes::board(c, {-8, 8, 1, 16}));
      const std::vector<double> h = scenes::homography_of(c);
      // Angles in plain double radians are good to 4e-16, the terms of an entry to a few ulp each.
      const double size = 1 + (1000 + 1000) / c.focal;
      for (std::size_t k = 0; k < 9; ++k) {
        const double scale = (k < 6 ? c.height : 1) * (k % 3 == 2 ? size : 1 / c.focal);
        CHECK(std::fabs(board.homography[k] - h[k]) <= 4e-15 * scale);
      }
    }
  }

  TEST_CASE("10,000 random edge pixels under the box are within 1e-13 of the oracle and their bounds") {
    Draw draw(11);
    compare_box(kBoxTolerance, [&](double reach) { return random_edge(draw, reach); });
  }

  TEST_CASE("10,000 random disk pixels under the box, radius 1e-6 to 1e9, are within 1e-13 and their bounds") {
    Draw draw(12);
    compare_box(kBoxTolerance, [&](double reach) { return random_disk(draw, reach); });
  }

  TEST_CASE("10,000 random board pixels under the box are within 1e-13 of the oracle and their bounds") {
    Draw draw(13);
    compare_box(kBoardBound, [&](double reach) { return random_board(draw, reach, kCells); });
  }

  TEST_CASE("300 random edge pixels under every other filter are within 1e-12 of the oracle and their bounds") {
    Draw draw(14);
    compare_wide(300, kWideTolerance, [&](double reach) { return random_edge(draw, reach); });
  }

  TEST_CASE("300 random disk pixels under every other filter are within 1e-12 of the oracle and their bounds") {
    Draw draw(15);
    compare_wide(300, kWideTolerance, [&](double reach) { return random_disk(draw, reach); });
  }
}

TEST_SUITE("heavy") {
  TEST_CASE("300 random board pixels under every other filter are within 1e-12 of the oracle and their bounds") {
    Draw draw(16);
    compare_wide(300, kBoardBound, [&](double reach) { return random_board(draw, reach, kCells); });
  }
}

TEST_SUITE("slow") {
  TEST_CASE("10,000 random edge pixels under every other filter are within 1e-12 of the oracle and their bounds") {
    Draw draw(17);
    compare_wide(10000, kWideTolerance, [&](double reach) { return random_edge(draw, reach); });
  }

  TEST_CASE("10,000 random disk pixels under every other filter are within 1e-12 of the oracle and their bounds") {
    Draw draw(18);
    compare_wide(10000, kWideTolerance, [&](double reach) { return random_disk(draw, reach); });
  }

  TEST_CASE("10,000 random board pixels under every other filter are within 1e-12 of the oracle and their bounds") {
    Draw draw(19);
    compare_wide(10000, kBoardBound, [&](double reach) { return random_board(draw, reach, kCells); });
  }
}

}  // namespace moire
