// Scan-time against its definition, followed literally, and the distances that it is made for.
#include <doctest/doctest.h>

#include <cmath>
#include <string>
#include <vector>

#include "core/hash.h"
#include "patterns/pattern.h"
#include "patterns/variants.h"

using namespace moire;
using namespace moire::test;

namespace {

long double on_circle(double a, double b) {
  const long double d = std::fabs(static_cast<long double>(a) - static_cast<long double>(b));
  return std::fmin(d, 1 - d);
}

long double distance(const PointSet& set, std::size_t i, std::size_t j, double time_of_i) {
  const long double dx = on_circle(set.x[i], set.x[j]), dy = on_circle(set.y[i], set.y[j]),
                    dt = on_circle(time_of_i, set.t[j]);
  return std::sqrt(dx * dx + dy * dy + dt * dt);
}

// Cells apart in one direction, on a ring of m.
int cells_apart(std::size_t a, std::size_t b, int m) {
  const int d = std::abs(static_cast<int>(a) - static_cast<int>(b));
  return std::min(d, m - d);
}

// The times by the definition: in raster order, of the candidates the one whose nearest earlier point within 8 cells is
// farthest. x and y are given. Extended precision finds the same maximum unless two candidates are equal to 1e-15.
std::vector<double> scanned(PointSet set, int k, Draw draw, Pixel pixel) {
  const auto m = static_cast<std::size_t>(std::lround(std::sqrt(static_cast<double>(set.x.size()))));
  const Key key = pixel_key(draw_hash(draw.seed, draw.trial), pixel);
  for (std::size_t i = 0; i < set.x.size(); ++i) {
    long double best = -1;
    double chosen = -1;
    for (int c = 0; c < k; ++c) {
      const Words w = hash(key, static_cast<std::uint32_t>(i), Axis::scan, static_cast<std::uint32_t>(c));
      const double time = unit(w.a, w.b);
      long double nearest = 2;
      for (std::size_t j = 0; j < i; ++j) {
        const int side = static_cast<int>(m);
        if (cells_apart(i % m, j % m, side) > 8 || cells_apart(i / m, j / m, side) > 8) continue;
        nearest = std::fmin(nearest, distance(set, i, j, time));
      }
      if (nearest > best) {
        best = nearest;
        chosen = time;
      }
    }
    set.t[i] = chosen;
  }
  return set.t;
}

double nearest_pair(const PointSet& set) {
  long double nearest = 2;
  for (std::size_t i = 0; i < set.x.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) nearest = std::fmin(nearest, distance(set, i, j, set.t[i]));
  return static_cast<double>(nearest);
}

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("scan-time chooses the times that its definition chooses") {
    // Sides of 1 to 5 cells, where all points are neighbours; of 16 to 18, where the neighbourhood begins to be a part;
    // of 20 and 26.
    for (const int m : {1, 2, 3, 4, 5, 16, 17, 18, 20, 26}) {
      for (const int k : {1, 2, 10, 13}) {
        CAPTURE(m);
        CAPTURE(k);
        for (std::uint32_t trial = 0; trial < (m <= 5 ? 20 : 1); ++trial) {
          const Draw draw{.seed = 7, .trial = trial};
          const Pixel pixel{-5, 1000};
          const PatternChoice choice = chosen("scan-time:k=" + std::to_string(k));
          const PointSet set = points_in(Pattern(choice, m * m, draw), {pixel});
          REQUIRE(set.t == scanned(set, k, draw, pixel));
        }
      }
    }
  }

  TEST_CASE("with one candidate the times of scan-time are random, with more of them points keep farther apart") {
    for (const int n : {16, 256}) {
      double random = 0, one = 0, ten = 0, many = 0;
      for (std::uint32_t trial = 0; trial < 40; ++trial) {
        random += nearest_pair(set_of("jittered-random-time", n, {.trial = trial}));
        one += nearest_pair(set_of("scan-time:k=1", n, {.trial = trial}));
        ten += nearest_pair(set_of("scan-time", n, {.trial = trial}));
        many += nearest_pair(set_of("scan-time:k=100", n, {.trial = trial}));
      }
      CAPTURE(n);
      CAPTURE(ten / random);
      CHECK(std::abs(one / random - 1) < 0.35);  // means of 40 minima, each with a deviation of about half of it
      CHECK(ten > 1.5 * random);
      CHECK(many > ten);
    }
  }
}
