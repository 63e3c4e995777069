// Where points must lie: one in each cell, row, column or elementary interval.
#include "patterns/strata.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "patterns/pattern.h"
#include "patterns/radical_inverse3.h"
#include "patterns/variants.h"

using namespace moire;
using namespace moire::test;

namespace {

// Whether x lies in [cell, cell + 1) / cells exactly: fma rounds once, so the signs are those of the true differences.
bool in_stratum(double x, int cell, int cells) {
  return std::fma(x, cells, -static_cast<double>(cell)) >= 0 && std::fma(x, cells, -(cell + 1.0)) < 0;
}

int stratum(double x, int cells) { return static_cast<int>(x * cells); }

// Whether every box of a columns x rows grid holds exactly one point.
bool one_in_each(const PointSet& set, int columns, int rows) {
  std::vector<int> count(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
  for (std::size_t i = 0; i < set.x.size(); ++i)
    ++count[static_cast<std::size_t>(stratum(set.x[i], columns) + columns * stratum(set.y[i], rows))];
  for (const int c : count)
    if (c != 1) return false;
  return true;
}

// sum of ((a_k + fold k) mod 2) 2^-(k+1) over the first 100 digits, correctly rounded unless the sum is within 2^-100
// of the middle between two doubles, which the repeating tail excludes.
double digit_sum(std::uint32_t i, bool fold) {
  __extension__ using Quad = __float128;
  Quad sum = 0, weight = static_cast<Quad>(0.5);
  for (unsigned k = 0; k < 100; ++k, weight /= 2) {
    const unsigned digit = k < 32 ? i >> k & 1 : 0;
    if ((digit + (fold ? k : 0)) % 2 == 1) sum += weight;
  }
  return static_cast<double>(sum);
}

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("the extreme offsets of a stratum stay strictly inside it, for every number of strata") {
    std::vector<int> numbers;
    for (int cells = 1; cells <= 4200; ++cells) numbers.push_back(cells);
    for (const int cells : {65535, 65536, 65537, 9'999'991, (1 << 24) - 1, 1 << 24, kTernaryCells, 1 << 30})
      numbers.push_back(cells);
    for (const int cells : numbers) {
      const Strata strata(cells);
      const double low = strata.offset(0.0), high = strata.offset(1 - 0x1p-52);
      REQUIRE(low > 0);
      REQUIRE(high == 1 - low);  // symmetric: the mean is the middle
      for (int cell = 0; cell < cells; cell += 1 + cells / 50)
        for (const int c : {cell, cells - 1 - cell})
          for (const double u : {low, high}) {
            const double x = strata.place(c, u);
            REQUIRE(in_stratum(x, c, cells));
            REQUIRE(stratum(x, cells) == c);  // also as a program would ask
          }
    }
  }

  TEST_CASE("an offset differs from the number that it is made of by less than 2^-25 stratum") {
    for (const int cells : {1, 2, 3, 16, 4096, 1 << 24}) {
      const Strata strata(cells);
      for (int i = 0; i < 1000; ++i) REQUIRE(std::abs(strata.offset(i / 1000.0) - i / 1000.0) < 0x1p-25);
    }
  }

  TEST_CASE("jittered and regular have point i in cell (i mod m, i / m)") {
    for (const std::string text : {"jittered", "jittered:amount=0", "jittered:amount=0.3", "regular", "scan-time"})
      for (const int m : {1, 2, 3, 5, 7, 16, 49, 100}) {
        CAPTURE(text);
        CAPTURE(m);
        for (std::uint32_t trial = 0; trial < 4; ++trial) {
          const PointSet set = set_of(text, m * m, {.trial = trial});
          for (int i = 0; i < m * m; ++i) {
            REQUIRE(in_stratum(set.x[static_cast<std::size_t>(i)], i % m, m));
            REQUIRE(in_stratum(set.y[static_cast<std::size_t>(i)], i / m, m));
          }
        }
      }
  }

  TEST_CASE("jitter of amount a stays within a/2 of the cell's middle, and amount 0 is the regular grid") {
    for (const double amount : {0.0, 0.01, 0.3, 0.5, 0.999}) {
      const int m = 8;
      double farthest = 0;
      for (std::uint32_t trial = 0; trial < 50; ++trial) {
        const PointSet set = set_of("jittered:amount=" + shortest(amount), m * m, {.trial = trial});
        for (std::size_t i = 0; i < set.x.size(); ++i)
          farthest = std::max({farthest, std::abs(set.x[i] * m - std::floor(set.x[i] * m) - 0.5),
                               std::abs(set.y[i] * m - std::floor(set.y[i] * m) - 0.5)});
      }
      CHECK(farthest <= amount / 2 + 1e-14);  // rounding of coordinates times m
      CHECK(farthest >= amount / 2 * 0.99);   // of 6400 numbers: not once in 10^27 draws of the seed
    }
    for (const int m : {1, 2, 3, 7, 49}) CHECK(set_of("jittered:amount=0", m * m) == set_of("regular", m * m));
  }

  TEST_CASE("n-rooks has one point in each column and in each row") {
    for (const int n : {1, 2, 3, 7, 16, 49, 1000, 65537})
      for (std::uint32_t trial = 0; trial < 3; ++trial) {
        CAPTURE(n);
        const PointSet set = set_of("n-rooks", n, {.trial = trial});
        std::vector<bool> taken(static_cast<std::size_t>(n));
        for (int i = 0; i < n; ++i) {
          const double x = set.x[static_cast<std::size_t>(i)], y = set.y[static_cast<std::size_t>(i)];
          const int row = stratum(y, n);
          REQUIRE(in_stratum(x, i, n));
          REQUIRE(in_stratum(y, row, n));
          REQUIRE(!taken[static_cast<std::size_t>(row)]);
          taken[static_cast<std::size_t>(row)] = true;
        }
      }
  }

  TEST_CASE("all permutations of n-rooks are equally likely") {
    // 24,000 pixels over the 4! permutations of 4 rows: chi-square with 23 degrees of freedom, mean 23, variance 46;
    // 67 is exceeded with probability 3e-6.
    const Pattern pattern(chosen("n-rooks"), 4, {.seed = 11});
    std::vector<int> count(256);
    for (int i = 0; i < 24000; ++i) {
      const PointSet set = points_in(pattern, {{i % 160, i / 160}});
      int code = 0;
      for (const double y : set.y) code = 4 * code + stratum(y, 4);
      ++count[static_cast<std::size_t>(code)];
    }
    int seen = 0;
    double chi_square = 0;
    for (const int c : count)
      if (c > 0) {
        ++seen;
        chi_square += (c - 1000.0) * (c - 1000.0) / 1000;
      }
    CHECK(seen == 24);
    CHECK(chi_square < 67);
  }

  TEST_CASE("2^k hammersley and zaremba points have one in each elementary interval, scrambled or not") {
    for (const std::string text :
         {"hammersley", "zaremba", "hammersley:instance=scramble", "zaremba:instance=scramble"})
      for (int k = 0; k <= 12; ++k)
        for (std::uint32_t trial = 0; trial < 3; ++trial) {
          const PointSet set = set_of(text, 1 << k, {.trial = trial});
          for (int a = 0; a <= k; ++a) {
            CAPTURE(text);
            CAPTURE(k);
            CAPTURE(a);
            CHECK(one_in_each(set, 1 << a, 1 << (k - a)));
          }
        }
  }

  TEST_CASE("a scrambled regular grid of 2^k x 2^k points has one in each cell") {
    for (const int m : {1, 2, 4, 16, 64})
      for (std::uint32_t trial = 0; trial < 5; ++trial)
        CHECK(one_in_each(set_of("regular:instance=scramble", m * m, {.trial = trial}), m, m));
  }

  TEST_CASE("a scramble changes each coordinate by one exclusive or of 52 digits for the whole pixel") {
    const auto digits = [](double v) { return static_cast<std::uint64_t>(v * 0x1p52); };
    for (const std::string text : {"regular", "hammersley", "zaremba"}) {
      const PointSet plain = set_of(text, 49), scrambled = set_of(text + ":instance=scramble", 49);
      for (std::size_t i = 0; i < 49; ++i) {
        CHECK((digits(plain.x[i]) ^ digits(scrambled.x[i])) == (digits(plain.x[0]) ^ digits(scrambled.x[0])));
        CHECK((digits(plain.y[i]) ^ digits(scrambled.y[i])) == (digits(plain.y[0]) ^ digits(scrambled.y[0])));
      }
    }
  }

  TEST_CASE("a shift moves all points of a pixel alike on the torus") {
    for (const std::string text : {"regular", "hammersley", "zaremba"}) {
      const PointSet plain = set_of(text, 49), shifted = set_of(text + ":instance=shift", 49);
      for (std::size_t i = 0; i < 49; ++i)
        for (const auto& [from, to] :
             {std::pair{&plain.x, &shifted.x}, std::pair{&plain.y, &shifted.y}, std::pair{&plain.t, &shifted.t}}) {
          if (from->empty()) continue;
          const double step = ((*to)[i] - (*from)[i]) - ((*to)[0] - (*from)[0]);
          CHECK(std::abs(step - std::round(step)) < 1e-15);  // four numbers below 1, each rounded by 2^-54 at most
        }
    }
  }

  TEST_CASE("hammersley and zaremba coordinates are their digit sums, correctly rounded") {
    for (const int n : {1, 7, 16, 1600, 4096}) {
      const PointSet h = set_of("hammersley", n), z = set_of("zaremba", n);
      for (int i = 0; i < n; ++i) {
        const auto p = static_cast<std::size_t>(i);
        REQUIRE(h.x[p] == static_cast<double>(i) / n);
        REQUIRE(z.x[p] == h.x[p]);
        REQUIRE(h.y[p] == digit_sum(static_cast<std::uint32_t>(i), false));
        REQUIRE(z.y[p] == digit_sum(static_cast<std::uint32_t>(i), true));
      }
    }
    CHECK(set_of("zaremba", 1).y[0] == 1.0 / 3);  // nothing but the folded tail 0.010101...
  }
}

TEST_SUITE("heavy") {
  TEST_CASE("at 2^24 samples every point of jittered and n-rooks is still in its stratum") {
    const int n = kMaxSamples, m = 4096;
    {
      const PointSet set = set_of("jittered", n);
      for (int i = 0; i < n; ++i) {
        const auto p = static_cast<std::size_t>(i);
        if (!in_stratum(set.x[p], i % m, m) || !in_stratum(set.y[p], i / m, m)) FAIL("point " << i);
      }
    }
    const PointSet set = set_of("n-rooks", n);
    std::vector<bool> taken(static_cast<std::size_t>(n));
    for (int i = 0; i < n; ++i) {
      const auto p = static_cast<std::size_t>(i), row = static_cast<std::size_t>(stratum(set.y[p], n));
      if (!in_stratum(set.x[p], i, n) || taken[row]) FAIL("point " << i);
      taken[row] = true;
    }
  }
}
