// Sums over periods against squares clipped one by one.
#include "oracle/one_point.h"

#include <doctest/doctest.h>

#include <cmath>
#include <stdexcept>
#include <string>

#include "oracle/coverage.h"
#include "oracle/filtered.h"

namespace moire::oracle {
namespace {

constexpr double kEndless = HUGE_VAL;

// a x + b W + begin, forward + e W, W = w (y - horizon) around pixel (0, 0)'s centre.
Board board(double a, double begin, double forward, double w, double horizon, double b = 0.25, double e = -0.375) {
  const double z = -w * (horizon + 0.5);
  return {{a, b * w, begin - 0.5 * a + b * z, 0, e * w, forward + e * z, 0, w, z},
          {-kEndless, kEndless, -kEndless, kEndless}};
}

bool near(const Value& a, const Value& b) { return std::fabs(a.value - b.value) <= a.error + b.error; }

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("below the horizon sums over periods are the squares' areas") {
    const Kernel box("box");
    for (const double a : {1.0, 3.0})
      for (const double begin : {0.5, -4.5})
        for (const double forward : {7.0, -30.0})
          for (const double horizon : {-1.0, -2.375}) {
            const Board b = board(a, begin, forward, 1, horizon);
            const Value periods = one_point(box, b, {0, 0}), clipped = coverage(b, {0, 0}, 1);
            CHECK(near(periods, clipped));
            CHECK(periods.error < 1e-16L);
            CHECK(clipped.error < 1e-16L);
          }
  }

  TEST_CASE("below the horizon kernels of degree up to 3 agree with sections of every square") {
    for (const char* text : {"box:width=2", "tent", "bspline:order=2", "bspline", "mitchell", "catmull-rom"}) {
      CAPTURE(std::string(text));
      const Kernel k(text);
      // Knots are 2, 1 or 1/2 + 1 pixels from the centre: the same whole squares as ever.
      const double shift = std::string(text) == "bspline:order=2" ? 0.5 : 0;
      const Board b = board(1, 2 + shift, 5, 1, -3);
      const Value periods = one_point(k, b, {0, 0}), sections = filtered(k, b, {0, 0});
      CHECK(near(periods, sections));
      CHECK(periods.error < 1e-9L);  // five pixels below the horizon: some ten bits for each axis
      CHECK(std::fabs(periods.value - sections.value) < 1e-14L);
    }
  }

  TEST_CASE("across the horizon sums over periods are within what 2000 squares leave open") {
    const Kernel box("box");
    for (const double horizon : {-0.5, -0.125, 0.25})
      for (const double begin : {0.5, -0.5, 12.5}) {
        const Board b = board(1, begin, 9, 0.25, horizon);
        const Value periods = one_point(box, b, {0, 0}), clipped = coverage(b, {0, 0}, 1, 2000);
        CHECK(near(periods, clipped));
        CHECK(periods.error < 1e-16L);
        CHECK(clipped.error < 0.15L);  // 2000 squares end a fifth of a pixel before the horizon
      }
  }

  TEST_CASE("a window above the horizon is empty, and boards of another kind are refused") {
    const Kernel box("box");
    CHECK(one_point(box, board(1, 0.5, 9, 1, 2), {0, 0}).value == 0);
    CHECK_THROWS_AS(one_point(box, board(1, 0.25, 9, 1, -2), {0, 0}), std::invalid_argument);
    CHECK_THROWS_AS(one_point(box, board(1, 0.5, 9.5, 1, -2), {0, 0}), std::invalid_argument);
    CHECK_THROWS_AS(one_point(Kernel("bspline:order=5"), board(1, 0.5, 9, 1, -2), {0, 0}), std::invalid_argument);
    Board yawed = board(1, 0.5, 9, 1, -2);
    yawed.homography[3] = 0.5;
    CHECK_THROWS_AS(one_point(box, yawed, {0, 0}), std::invalid_argument);
  }
}

}  // namespace moire::oracle
