// Exact values against the oracle on random pixels that the boundary crosses.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>

#include "engine/exact_compare.h"
#include "engine/random_scenes.h"

namespace moire {
namespace {

constexpr double kBoxTolerance = 1e-13;   // what moire promises for the box
constexpr double kWideTolerance = 1e-12;  // and for every other filter
constexpr double kMedianBound = 1e-13;    // and for the median of the bounds, per filter and kind of scene

// Squares in a window: enough for corners, rims and rows of squares; the oracle's time grows with them.
constexpr double kCells = 30;

// The plane without end, in windows that are well in front of its horizon: there the oracle can have all its squares.
RandomCase random_plane(Draw& draw, double reach, double cells) {
  for (;;) {
    const RandomCase c = random_board(draw, reach, cells);
    const std::array<double, 9> h = oracle::board_of(c.image).homography;
    const double x = static_cast<double>(c.pixel.x) + 0.5, y = static_cast<double>(c.pixel.y) + 0.5;
    const double depth = h[6] * x + h[7] * y + h[8], fall = (std::fabs(h[6]) + std::fabs(h[7])) * reach;
    if (depth > 2 * fall) return {scenes::plane({h.begin(), h.end()}), c.pixel};
  }
}

template <class Next>
void compare_box(const Next& next) {
  ExactComparison compare("box", kBoxTolerance);
  for (int i = 0; i < 10000; ++i) {
    const RandomCase c = next(compare.radius());
    compare(c.image, c.pixel);
  }
  MESSAGE(compare.summary());
  CHECK(compare.partial() > 9000);  // the generators aim at the boundary: the cases are no flat pixels
  CHECK(compare.median_bound() < kMedianBound);
}

// How many pixels of each filter: the oracle needs 20 times as long for a board under a kernel that is no polynomial.
struct Pixels {
  int polynomial, other;
};

template <class Next>
void compare_wide(Pixels pixels, const Next& next) {
  for (const std::string& filter : wide_filters()) {
    CAPTURE(filter);
    const bool polynomial = oracle::half_kernel(parse_spec(filter, "test")).degree >= 0;
    ExactComparison compare(filter, kWideTolerance);
    for (int i = 0; i < (polynomial ? pixels.polynomial : pixels.other); ++i) {
      const RandomCase c = next(compare.radius());
      compare(c.image, c.pixel);
    }
    MESSAGE(compare.summary());
    CHECK(compare.median_bound() < kMedianBound);
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
    compare_box([&](double reach) { return random_edge(draw, reach); });
  }

  TEST_CASE("10,000 random disk pixels under the box, radius 1e-6 to 1e9, are within 1e-13 and their bounds") {
    Draw draw(12);
    compare_box([&](double reach) { return random_disk(draw, reach); });
  }

  TEST_CASE("10,000 random board pixels under the box are within 1e-13 of the oracle and their bounds") {
    Draw draw(13);
    compare_box([&](double reach) { return random_board(draw, reach, kCells); });
  }

  TEST_CASE("10,000 random pixels of the plane under the box are within 1e-13 of the oracle and their bounds") {
    Draw draw(20);
    compare_box([&](double reach) { return random_plane(draw, reach, kCells); });
  }
}

TEST_SUITE("heavy") {
  TEST_CASE("random edge pixels under every other filter are within 1e-12 of the oracle and their bounds") {
    Draw draw(14);
    compare_wide({200, 120}, [&](double reach) { return random_edge(draw, reach); });
  }

  TEST_CASE("random disk pixels under every other filter are within 1e-12 of the oracle and their bounds") {
    Draw draw(15);
    compare_wide({200, 120}, [&](double reach) { return random_disk(draw, reach); });
  }

  TEST_CASE("random board pixels under every other filter are within 1e-12 of the oracle and their bounds") {
    Draw draw(16);
    compare_wide({100, 40}, [&](double reach) { return random_board(draw, reach, kCells); });
  }

  TEST_CASE("random pixels of the plane under every other filter are within 1e-12 of the oracle and their bounds") {
    Draw draw(21);
    compare_wide({100, 40}, [&](double reach) { return random_plane(draw, reach, kCells); });
  }
}

// Together 10^5 pixels and more.
TEST_SUITE("slow") {
  TEST_CASE("many random edge pixels under every other filter are within 1e-12 of the oracle and their bounds") {
    Draw draw(17);
    compare_wide({700, 500}, [&](double reach) { return random_edge(draw, reach); });
  }

  TEST_CASE("many random disk pixels under every other filter are within 1e-12 of the oracle and their bounds") {
    Draw draw(18);
    compare_wide({700, 500}, [&](double reach) { return random_disk(draw, reach); });
  }

  TEST_CASE("many random board pixels under every other filter are within 1e-12 of the oracle and their bounds") {
    Draw draw(19);
    compare_wide({500, 100}, [&](double reach) { return random_board(draw, reach, kCells); });
  }

  TEST_CASE("many random pixels of the plane under every other filter are within 1e-12 and their bounds") {
    Draw draw(22);
    compare_wide({500, 100}, [&](double reach) { return random_plane(draw, reach, kCells); });
  }
}

}  // namespace moire
