// The star L2 discrepancy T of each pattern against exact and published values: the sharpest single check that a
// pattern is the one it says it is. D. P. Mitchell, "Ray tracing and irregularities of distribution", 1992, tables 1
// and 2.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "patterns/pattern.h"
#include "patterns/variants.h"

using namespace moire;
using namespace moire::test;

namespace {

__extension__ using Quad = __float128;

// T^2 by T. T. Warnock's closed form (1972) in `dims` dimensions, 2 or, with t, 3. The three terms cancel: in Real =
// double the result has an absolute error of about 1e-16, which is 1e-9 of T^2 at N = 1600.
template <class Real, int dims = 2>
Real star_l2_squared(const PointSet& set) {
  const std::size_t n = set.x.size();
  const std::array<const double*, 3> axes = {set.x.data(), set.y.data(), set.t.data()};
  Real single = 0, pairs = 0;
  for (std::size_t i = 0; i < n; ++i) {
    Real outside = 1, own = 1, row = 0;
    for (std::size_t d = 0; d < dims; ++d) {
      const auto x = static_cast<Real>(axes[d][i]);
      outside *= 1 - x * x;
      own *= 1 - x;
    }
    for (std::size_t j = 0; j < i; ++j) {
      Real both = 1;
      for (std::size_t d = 0; d < dims; ++d) both *= 1 - static_cast<Real>(std::max(axes[d][i], axes[d][j]));
      row += both;
    }
    single += outside;
    pairs += 2 * row + own;
  }
  const Real count = static_cast<Real>(n);
  return static_cast<Real>(1) / (dims == 2 ? 9 : 27) - single / ((dims == 2 ? 2 : 4) * count) + pairs / (count * count);
}

struct Sample {
  double mean_t, error_t, mean_square, error_square;  // with their standard errors
};

template <int dims = 2>
Sample sample(const std::string& text, int n, int trials) {
  double t = 0, t2 = 0, t4 = 0;
  for (int trial = 0; trial < trials; ++trial) {
    const double square =
        star_l2_squared<double, dims>(set_of(text, n, {.seed = 1, .trial = static_cast<std::uint32_t>(trial)}));
    t += std::sqrt(square);
    t2 += square;
    t4 += square * square;
  }
  t /= trials;
  t2 /= trials;
  t4 /= trials;
  return {t, std::sqrt((t2 - t * t) / (trials - 1)), t2, std::sqrt((t4 - t2 * t2) / (trials - 1))};
}

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("zaremba and hammersley have the exact discrepancies of their definitions") {
    // T computed once in exact rational arithmetic from the definitions. Rounding a coordinate to 53 bits changes T^2
    // by less than 2 T 2^-54, so T by less than 1.2e-16: 3e-13 of the least T here.
    struct Golden {
      const char* pattern;
      int n;
      double t;
    };
    for (const Golden& g :
         {Golden{"zaremba", 16, 0.035833915291725360263}, Golden{"zaremba", 256, 0.0025506347594631668442},
          Golden{"zaremba", 1600, 0.00043757326086522530696}, Golden{"hammersley", 16, 0.069290838961877194254},
          Golden{"hammersley", 256, 0.0062772313974000947323}, Golden{"hammersley", 1600, 0.0012159015720708560946}}) {
      CAPTURE(g.pattern);
      CAPTURE(g.n);
      const double t = std::sqrt(static_cast<double>(star_l2_squared<Quad>(set_of(g.pattern, g.n))));
      CHECK(std::abs(t / g.t - 1) < 1e-12);
    }
    // Two of them as fractions: T^2 at N = 16.
    CHECK(std::abs(static_cast<double>(star_l2_squared<Quad>(set_of("zaremba", 16))) / (6059.0 / 4718592) - 1) < 1e-14);
    CHECK(std::abs(static_cast<double>(star_l2_squared<Quad>(set_of("hammersley", 16))) / (22655.0 / 4718592) - 1) <
          1e-14);
  }

  TEST_CASE(
      "with their times zaremba and hammersley have the exact discrepancies of their definitions in 3 dimensions") {
    // As above; the third coordinate is rounded, too: T moves by less than 1.7e-16, 3e-13 of the least T here.
    struct Golden {
      const char* pattern;
      int n;
      double t;
    };
    for (const Golden& g :
         {Golden{"zaremba", 16, 0.039300781808251989511}, Golden{"zaremba", 256, 0.0037564252486621628653},
          Golden{"zaremba", 1600, 0.00076065694290809752117}, Golden{"hammersley", 16, 0.078142128153915799641},
          Golden{"hammersley", 256, 0.0067783607333074019948}, Golden{"hammersley", 1600, 0.0013487917852103975493}}) {
      CAPTURE(g.pattern);
      CAPTURE(g.n);
      const double t = std::sqrt(static_cast<double>(star_l2_squared<Quad, 3>(set_of(g.pattern, g.n))));
      CHECK(std::abs(t / g.t - 1) < 1e-12);
    }
    // Two of them as fractions: T^2 at N = 16.
    const auto square = [](const char* text) {
      return static_cast<double>(star_l2_squared<Quad, 3>(set_of(text, 16)));
    };
    CHECK(std::abs(square("zaremba") / (2394405889.0 / 1550227341312) - 1) < 1e-14);
    CHECK(std::abs(square("hammersley") / (777941.0 / 127401984) - 1) < 1e-14);
  }

  TEST_CASE("with random times random and jittered points have the expected mean square discrepancy in 3 dimensions") {
    for (const int n : {4, 16, 256}) {
      CAPTURE(n);
      const int trials = n == 256 ? 400 : 2000;
      // Random: (2^-3 - 3^-3)/N. Jittered, with p the part of a cell that the box covers in (x, y): a point is in the
      // box with probability p t, so N^2 E[T^2] is the mean over boxes of sum(p t) - sum(p^2 t^2) = sum(p)/2 -
      // sum(p^2)/3 = sum(p)/6 + sum(p - p^2)/3. The mean of sum(p) is N/4; that of sum(p - p^2) is N^2 E[T^2] in two
      // dimensions.
      const double count = n, flat = (std::sqrt(count) - 1) / 6 + 5.0 / 36;
      const double random = (1.0 / 8 - 1.0 / 27) / count, jittered = (count / 24 + flat / 3) / (count * count);
      const Sample r = sample<3>("random", n, trials), j = sample<3>("jittered-random-time", n, trials);
      CHECK(std::abs(r.mean_square - random) < 4 * r.error_square);
      CHECK(std::abs(j.mean_square - jittered) < 4 * j.error_square);
    }
  }

  TEST_CASE("scan-time has the mean discrepancy in 3 dimensions that was measured when it was derived, within 5%") {
    // Means of T of an independent implementation, 3000 trials at 16 and 400 at 256. T varies by some 15% of its mean
    // from set to set: the standard errors of the means here are below 1%, those of the means there at most that.
    struct Row {
      int n;
      double t;
    };
    for (const Row& row : {Row{16, 0.0467}, Row{256, 0.0075}}) {
      CAPTURE(row.n);
      const Sample s = sample<3>("scan-time", row.n, 500);
      CAPTURE(s.mean_t);
      CHECK(s.error_t < 0.01 * s.mean_t);
      CHECK(std::abs(s.mean_t / row.t - 1) < 0.05);
    }
  }

  TEST_CASE("random, jittered and n-rooks have the expected mean square discrepancy, within 4 standard errors") {
    for (const int n : {4, 16, 256}) {
      CAPTURE(n);
      const int trials = n == 256 ? 400 : 2000;
      const double count = n, side = std::sqrt(count);
      // E[T^2] in closed form. Random: 5/(36 N). Jittered: ((s - 1)/6 + 5/36)/N^2, s the points per side.
      const double random = 5 / (36 * count), jittered = ((side - 1) / 6 + 5.0 / 36) / (count * count);
      // N-rooks: E is the mean of (1 - max) over two different points of one axis.
      const double e = (1.0 / 3 - (0.5 - 1 / (6 * count)) / count) / (1 - 1 / count);
      const double rooks = -1.0 / 9 + 1 / (4 * count) + (1 - 1 / count) * e * e;
      struct Row {
        const char* pattern;
        double expected;
      };
      for (const Row& row : {Row{"random", random}, Row{"jittered", jittered}, Row{"n-rooks", rooks}}) {
        CAPTURE(row.pattern);
        const Sample s = sample(row.pattern, n, trials);
        CHECK(std::abs(s.mean_square - row.expected) < 4 * s.error_square);
      }
    }
  }

  TEST_CASE("the sets of dart-throwing's pixels have the discrepancy of its set of a draw") {
    // The law on the torus does not change under a shift; n = 16, 400 independent sets each way.
    const Sample drawn = sample("dart-throwing:k=500", 16, 400);
    double t = 0, t2 = 0;
    constexpr int kPixels = 400;
    const Pattern pattern(chosen("dart-throwing:k=500,bank=0"), 16, {.seed = 2});
    for (int i = 0; i < kPixels; ++i) {
      const double square = star_l2_squared<double>(points_in(pattern, {{i, 5}}));
      t += std::sqrt(square) / kPixels;
      t2 += square / kPixels;
    }
    CHECK(std::abs(t - drawn.mean_t) < 4 * std::hypot(drawn.error_t, std::sqrt((t2 - t * t) / kPixels)));
  }
}

TEST_SUITE("heavy") {
  TEST_CASE("the mean discrepancies are those measured for Mitchell's table 1, within 4 standard errors") {
    // Means of T and their standard errors from an independent reimplementation of the paper's patterns, 100 trials.
    struct Row {
      const char* pattern;
      int n;
      double t, error;
    };
    for (const Row& row : {Row{"random", 16, 0.0904, 0.0028}, Row{"random", 256, 0.0224, 0.0007},
                           Row{"jittered", 16, 0.04950, 0.00060}, Row{"jittered", 256, 0.00634, 0.00004},
                           Row{"n-rooks", 16, 0.04678, 0.00088}, Row{"n-rooks", 256, 0.01022, 0.00025},
                           Row{"dart-throwing", 16, 0.05167, 0.0012}, Row{"dart-throwing", 256, 0.00807, 0.0002}}) {
      CAPTURE(row.pattern);
      CAPTURE(row.n);
      const Sample s = sample(row.pattern, row.n, row.n == 16 ? 400 : 200);
      CAPTURE(s.mean_t);
      CHECK(std::abs(s.mean_t - row.t) < 4 * std::hypot(s.error_t, row.error));
    }
  }
}
