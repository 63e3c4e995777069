// The quick answer to whether a rectangle lies in one square of a board, against the board's definition at the
// rectangle's corners in 113-bit arithmetic. Lines of the board are straight: a rectangle in front of the horizon lies
// in one square if its corners do.
#include "testimages/board_cover.h"

#include <doctest/doctest.h>
#include <quadmath.h>

#include <array>
#include <cmath>
#include <optional>
#include <random>

using namespace moire;

namespace {

using Quad = __float128;

// What the closed rectangle holds. None where it meets the horizon or the sky.
std::optional<Cover> by_definition(const Matrix3& h, const Extent& e, Pixel origin, Rect r) {
  Quad low[2], high[2];
  int behind = 0;
  for (int i = 0; i < 4; ++i) {
    const Quad x = Quad(origin.x) + (i % 2 == 0 ? r.lo.x : r.hi.x), y = Quad(origin.y) + (i < 2 ? r.lo.y : r.hi.y);
    const Quad w = h[6] * x + h[7] * y + h[8];
    if (w <= 0) ++behind;
    for (std::size_t f = 0; f < 2; ++f) {
      const Quad q = (h[3 * f] * x + h[3 * f + 1] * y + h[3 * f + 2]) / w;
      if (i == 0 || q < low[f]) low[f] = q;
      if (i == 0 || q > high[f]) high[f] = q;
    }
  }
  if (behind == 4) return Cover::none;
  if (behind > 0) return std::nullopt;
  const Quad sides[2][2] = {{e.u0, e.u1}, {e.v0, e.v1}};
  bool one = true;  // in one square, and that on the board
  Quad sum = 0;
  for (std::size_t f = 0; f < 2; ++f) {
    if (high[f] < sides[f][0] || low[f] > sides[f][1]) return Cover::none;
    one = one && low[f] >= sides[f][0] && high[f] <= sides[f][1] && floorq(low[f]) == floorq(high[f]);
    sum += floorq(low[f]);
  }
  if (!one) return Cover::partial;
  return fmodq(sum, 2) == 0 ? Cover::all : Cover::none;
}

class Draw {
 public:
  double uniform(double lo, double hi) { return lo + (hi - lo) * (static_cast<double>(random_() >> 11) * 0x1p-53); }
  double log_uniform(double lo, double hi) { return std::exp(uniform(std::log(lo), std::log(hi))); }

 private:
  std::mt19937_64 random_{41};
};

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("quick answers about rectangles on boards are those of the definition, and rarely missing") {
    Draw draw;
    int answers[3] = {}, known = 0, missing = 0, wrong = 0;
    for (int i = 0; i < 200000; ++i) {
      // Rows that are no larger than 1; W above 0 in most of the image.
      Matrix3 h;
      for (std::size_t k = 0; k < 9; ++k) h[k] = draw.uniform(-1, 1) * (k % 3 == 2 ? 1 : 4e-3);
      const double squares = draw.log_uniform(0.1, 1), tilt = draw.log_uniform(1e-3, 1);
      h[6] *= tilt, h[7] *= tilt, h[8] = squares * 0.1;
      Extent extent;
      if (i % 2 == 0) {
        extent = {std::floor(draw.uniform(-20, 0)), std::floor(draw.uniform(1, 20)), draw.uniform(-20, 0),
                  draw.uniform(1, 20)};
      }
      const Pixel origin{static_cast<std::int64_t>(draw.uniform(-500, 500)),
                         static_cast<std::int64_t>(draw.uniform(-500, 500))};
      const double size = draw.log_uniform(0.1, 100);
      const Vec2 lo{draw.uniform(-2, 2), draw.uniform(-2, 2)};
      const Rect r{lo, {lo.x + size, lo.y + size * draw.uniform(0.5, 2)}};
      const std::optional<Cover> truth = by_definition(h, extent, origin, r), quick = quick_cover(h, extent, origin, r);
      if (!truth) {
        CHECK(!quick);
        continue;
      }
      ++known;
      if (!quick) {
        ++missing;
        continue;
      }
      ++answers[static_cast<int>(*quick)];
      wrong += *quick != *truth;
    }
    MESSAGE(known, " rectangles clear of the horizon, ", missing, " without a quick answer");
    CHECK(wrong == 0);
    // Rectangles that meet the rim have none.
    CHECK(missing < known / 10);
    for (const int n : answers) CHECK(n > 10000);
  }

  TEST_CASE("rectangles that touch a line, or miss it by less than rounding, have no quick answer but partial") {
    // Squares of four pixels, lines at x, y = 0, 4, 8, ...
    const Matrix3 h{0.25, 0, 0, 0, 0.25, 0, 0, 0, 1};
    for (const double off : {0.0, 1e-16, -1e-16}) {
      for (const double x : {0.0, 4.0, 400.0}) {
        CHECK(!quick_cover(h, {}, {0, 0}, {{x + off, 1}, {x + 1, 2}}));
        CHECK(!quick_cover(h, {}, {0, 0}, {{1, x + 3}, {2, x + 4 + off}}));
      }
    }
    CHECK(quick_cover(h, {}, {0, 0}, {{1e-9, 1}, {1, 2}}) == Cover::all);
    CHECK(quick_cover(h, {}, {0, 0}, {{-1e-9, 1}, {1, 2}}) == Cover::partial);
    CHECK(quick_cover(h, {}, {4, 0}, {{1e-9, 1}, {1, 2}}) == Cover::none);
  }
}
