// Times of the points of deterministic patterns, which are radical inverses in base 3, and of jittered points.
#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <numeric>
#include <string>
#include <vector>

#include "patterns/pattern.h"
#include "patterns/radical_inverse3.h"
#include "patterns/variants.h"

using namespace moire;
using namespace moire::test;

namespace {

__extension__ using Quad = __float128;

// sum of ((a_k + fold k) mod 3) 3^-(k+1) over the first 80 digits, for i < 3^8. It is correctly rounded: the sum is off
// by less than 2^-104, but the number itself, 0 or p / (26 * 3^9) with p not a multiple of 13 or p / 3^8, is no middle
// between two doubles, multiples of 2^-68 here, and so differs from these by 2^-88 or more.
double digit_sum(std::uint32_t i, bool fold) {
  Quad sum = 0, weight = 1;
  for (unsigned k = 0; k < 80; ++k, i /= 3) {
    weight /= 3;
    sum += static_cast<Quad>((i % 3 + (fold ? k : 0)) % 3) * weight;
  }
  return static_cast<double>(sum);
}

// Whether each of by_y intervals of y times by_t intervals of t holds exactly one point. `slack`: how far below the
// beginning of its interval a time may lie because it was rounded, in intervals.
bool one_in_each(const PointSet& set, int by_y, int by_t, double slack) {
  std::vector<int> count(static_cast<std::size_t>(by_y) * static_cast<std::size_t>(by_t));
  for (std::size_t i = 0; i < set.y.size(); ++i) {
    const auto row = static_cast<std::size_t>(set.y[i] * by_y),
               slice = static_cast<std::size_t>(set.t[i] * by_t + slack);
    ++count[row * static_cast<std::size_t>(by_t) + slice];
  }
  for (const int c : count)
    if (c != 1) return false;
  return true;
}

// The first 18 digits of t in base 3, the first one after the point first.
std::array<int, kTernaryDigits> ternary_digits(double t) {
  // A plain phi_3 is a multiple of 3^-18, or of a larger power, that was rounded by less than 2^-54, 3e-8 in units of
  // 3^-18; the folded and the scrambled ones are farther than that from all of these multiples.
  auto cell = static_cast<std::int64_t>(t * kTernaryCells + 1e-6);
  std::array<int, kTernaryDigits> digits{};
  for (std::size_t k = digits.size(); k-- > 0; cell /= 3) digits[k] = static_cast<int>(cell % 3);
  return digits;
}

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("times of hammersley and zaremba are their digit sums in base 3, correctly rounded") {
    for (const int n : {1, 2, 3, 4, 26, 27, 28, 1600, 6561}) {
      const PointSet h = set_of("hammersley", n), z = set_of("zaremba", n);
      for (int i = 0; i < n; ++i) {
        const auto p = static_cast<std::size_t>(i);
        REQUIRE(h.t[p] == digit_sum(static_cast<std::uint32_t>(i), false));
        REQUIRE(z.t[p] == digit_sum(static_cast<std::uint32_t>(i), true));
      }
    }
    CHECK(set_of("zaremba", 1).t[0] == 5.0 / 26);  // nothing but the folded tail 0.012012...
  }

  TEST_CASE("any number added to the digits gives the sums of the changed digits, whatever the number of points") {
    const TernaryDigits add = {2, 0, 1, 1, 2, 0, 0, 2, 1, 0, 1, 2, 2, 2, 0, 1, 0, 1};
    for (const std::size_t n : {1u, 2u, 3u, 8u, 9u, 10u, 20u, 81u, 100u, 2000u}) {
      std::vector<double> cells(n + 1, -1.0);
      ternary_inverses(add, std::span(cells).first(n));
      for (std::size_t i = 0; i < n; ++i) {
        std::int64_t cell = 0;
        std::size_t rest = i;
        for (std::size_t k = 0; k < add.size(); ++k, rest /= 3)
          cell = 3 * cell + (static_cast<int>(rest % 3) + add[k]) % 3;
        REQUIRE(cells[i] == static_cast<double>(cell));
      }
      CHECK(cells[n] == -1);
    }
    ternary_inverses(add, {});
  }

  TEST_CASE("2^b 3^c hammersley and zaremba points have one in each elementary interval of (y, t), scrambled or not") {
    // The Chinese remainder theorem: the first b binary and the first c ternary digits of 2^b 3^c consecutive indices
    // take all combinations. Unscrambled numbers are interval ends, rounded: by less than 3^7 2^-54 in units of them.
    for (const std::string name : {"hammersley", "zaremba"})
      for (const bool scramble : {false, true})
        for (int b = 0, by_y = 1; b <= 6; ++b, by_y *= 2)
          for (int c = 0, by_t = 1; c <= 5; ++c, by_t *= 3)
            for (std::uint32_t trial = 0; trial < (scramble ? 3 : 1); ++trial) {
              const std::string text = name + (scramble ? ":instance=scramble" : "");
              CAPTURE(text);
              CAPTURE(b);
              CAPTURE(c);
              CHECK(one_in_each(set_of(text, by_y * by_t, {.trial = trial}), by_y, by_t, scramble ? 0 : 1e-12));
            }
  }

  TEST_CASE("3^k scrambled times have one in each interval of length 3^-j, for each 3^j consecutive indices") {
    const int n = 2187;
    for (const std::string name : {"hammersley", "zaremba"})
      for (std::uint32_t trial = 0; trial < 5; ++trial) {
        const PointSet set = set_of(name + ":instance=scramble", n, {.trial = trial});
        for (std::size_t block = 1; block <= static_cast<std::size_t>(n); block *= 3)
          for (std::size_t begin = 0; begin < set.t.size(); begin += block) {
            std::vector<bool> taken(block);
            for (std::size_t i = begin; i < begin + block; ++i) {
              const auto slice = static_cast<std::size_t>(set.t[i] * static_cast<double>(block));
              REQUIRE(!taken[slice]);
              taken[slice] = true;
            }
          }
      }
  }

  TEST_CASE("a scramble adds the same number to a ternary digit of the times of all points, modulo 3") {
    const int n = 500;
    std::array<std::array<int, 3>, kTernaryDigits> seen{};
    for (const std::string name : {"hammersley", "zaremba"}) {
      const PointSet plain = set_of(name, n);
      for (std::uint32_t trial = 0; trial < 300; ++trial) {
        const PointSet scrambled = set_of(name + ":instance=scramble", n, {.trial = trial});
        const auto first = ternary_digits(plain.t[0]), changed = ternary_digits(scrambled.t[0]);
        std::array<int, kTernaryDigits> add{};
        for (std::size_t k = 0; k < add.size(); ++k) {
          add[k] = (changed[k] + 3 - first[k]) % 3;
          ++seen[k][static_cast<std::size_t>(add[k])];
        }
        for (std::size_t i = 0; i < plain.t.size(); i += 7) {
          const auto from = ternary_digits(plain.t[i]), to = ternary_digits(scrambled.t[i]);
          for (std::size_t k = 0; k < add.size(); ++k) REQUIRE(to[k] == (from[k] + add[k]) % 3);
        }
        REQUIRE(scrambled.t[0] * kTernaryCells != std::floor(scrambled.t[0] * kTernaryCells));  // strictly inside
      }
    }
    // 600 scrambles, each number for a digit 200 times with a standard deviation of 11.5. Of the 54 counts none is
    // farther than 5 of these but with probability 3e-5.
    for (const auto& counts : seen)
      for (const int c : counts) CHECK(std::abs(c - 200) < 58);
  }

  TEST_CASE("the points of jittered-random-time and of scan-time are those of jittered") {
    for (const char* parameters : {"", ":amount=0", ":amount=0.3", ":cells=oblong"}) {
      CAPTURE(parameters);
      const std::string given = parameters;
      for (const int n : {1, 16, 49, 256}) {
        for (const Pixel pixel : {Pixel{0, 0}, Pixel{-3, 17}}) {
          const Draw draw{.seed = 4, .trial = 9};
          const PointSet points = points_in(Pattern(chosen("jittered" + given), n, draw), {pixel});
          const PointSet timed = points_in(Pattern(chosen("jittered-random-time" + given), n, draw), {pixel});
          CHECK(timed.x == points.x);
          CHECK(timed.y == points.y);
          if (!given.empty()) continue;
          const PointSet scanned = points_in(Pattern(chosen("scan-time"), n, draw), {pixel});
          CHECK(scanned.x == points.x);
          CHECK(scanned.y == points.y);
        }
      }
      const PatternChoice plain = chosen("jittered" + given), timed = chosen("jittered-random-time" + given);
      for (int n = 1; n <= 100; ++n) {
        CHECK(plain.info().counts(plain.args(), n).below == timed.info().counts(timed.args(), n).below);
        CHECK(plain.info().counts(plain.args(), n).above == timed.info().counts(timed.args(), n).above);
      }
      const Grid area{12, 7};
      const auto count = static_cast<std::size_t>(plain.area_count(area, 3));
      REQUIRE(timed.area_count(area, 3) == plain.area_count(area, 3));
      PointSet a = room_for(count, false), b = room_for(count, true);
      plain.info().fill_area(plain.args(), area, {}, points_of(a));
      timed.info().fill_area(timed.args(), area, {}, points_of(b));
      CHECK(a.x == b.x);
      CHECK(a.y == b.y);
    }
  }

  TEST_CASE("times of random points are correlated with neither coordinate nor with their neighbours' times") {
    for (const char* text : {"random", "jittered-random-time"}) {
      CAPTURE(text);
      const int n = 65536;
      const PointSet set = set_of(text, n);
      const std::vector<double> ahead(set.t.begin() + 1, set.t.end());
      for (const std::vector<double>* other : {&set.x, &set.y, &ahead}) {
        double sum = 0;
        for (std::size_t i = 0; i < other->size(); ++i) sum += (set.t[i] - 0.5) * ((*other)[i] - 0.5);
        CHECK(std::abs(sum) < 5 * std::sqrt(n) / 12);  // the product of two such numbers has the variance 1/144
      }
    }
  }
}
