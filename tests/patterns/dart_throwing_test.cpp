// Dart-throwing as a pattern: its sets are those of the process, and a pixel takes one of a bank.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <thread>
#include <vector>

#include "chi_square.h"
#include "core/error.h"
#include "core/hash.h"
#include "patterns/dart_process.h"
#include "patterns/pattern.h"
#include "patterns/variants.h"

using namespace moire;
using namespace moire::test;

namespace {

double torus_distance2(double ax, double ay, double bx, double by) {
  double dx = std::abs(ax - bx), dy = std::abs(ay - by);
  dx = std::min(dx, 1 - dx);
  dy = std::min(dy, 1 - dy);
  return dx * dx + dy * dy;
}

struct Thrown {
  PointSet set;
  double radius;  // at the end
};

Thrown thrown(const Key& key, Axis axis, int n, int k) {
  const double r = std::sqrt(2 / (std::sqrt(3.0) * n));
  DartProcess::Memory memory(n, r, 1, 1, 1024);
  const auto count = static_cast<std::size_t>(n);
  Thrown t{{std::vector<double>(count), std::vector<double>(count)}, 0};
  t.radius = DartProcess(key, axis, k, memory, t.set.x.data(), t.set.y.data()).run(n);
  return t;
}

double least_distance(const PointSet& set) {
  double least2 = 2;
  for (std::size_t i = 0; i < set.x.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      least2 = std::min(least2, torus_distance2(set.x[i], set.y[i], set.x[j], set.y[j]));
  return std::sqrt(least2);
}

std::string text(int k, int bank) { return "dart-throwing:k=" + std::to_string(k) + ",bank=" + std::to_string(bank); }

// What tells sets apart whatever their shift: where the second point is, seen from the first.
std::pair<double, double> shape(const PointSet& points, std::size_t first) {
  const auto rounded = [](double v) { return std::round((v - std::floor(v)) * 1e9); };
  return {rounded(points.x[first + 1] - points.x[first]), rounded(points.y[first + 1] - points.y[first])};
}

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("a set is that of its key, whatever the bank, and no two of its points are nearer than r") {
    for (const int n : {1, 2, 3, 4, 5, 8, 11, 12, 13, 16, 50, 64, 200, 500})
      for (const int k : {1, 10, 300}) {
        CAPTURE(n);
        CAPTURE(k);
        const Draw draw{.seed = 21, .trial = static_cast<std::uint32_t>(n)};
        const std::uint64_t common = draw_hash(draw.seed, draw.trial);
        const Thrown alone = thrown(pixel_key(common, {}), Axis::set, n, k);
        CHECK(set_of(text(k, 64), n, draw) == alone.set);
        CHECK(set_of(text(k, 0), n, draw) == alone.set);  // the set of a draw has nothing to do with the bank
        CHECK((n == 1 || least_distance(alone.set) >= alone.radius));

        const Pixel pixel{-7, 3};
        CHECK(points_in(Pattern(chosen(text(k, 0)), n, draw), {pixel}) ==
              thrown(pixel_key(common, pixel), Axis::dart, n, k).set);
      }
  }

  TEST_CASE("with k = 5000 sets of 256 points reach 0.70 to 0.80 of the largest possible distance") {
    // Saturated random packings have about 0.75 of it (Lagae and Dutre 2008, section 2; Mitchell's darts likewise).
    for (std::uint32_t trial = 0; trial < 10; ++trial) {
      const double largest = std::sqrt(2 / (std::sqrt(3.0) * 256));
      const double least = least_distance(set_of("dart-throwing", 256, {.trial = trial}));
      CHECK(least > 0.70 * largest);
      CHECK(least < 0.80 * largest);
    }
  }

  TEST_CASE("a pixel takes one of `bank` sets, each as often, shifted on the torus") {
    constexpr int kPixels = 6400, kBank = 64;
    for (const int n : {2, 16}) {
      const Pattern pattern(chosen(text(50, kBank)), n, {.seed = 4});
      std::vector<Pixel> run;
      for (int i = 0; i < kPixels; ++i) run.push_back({i % 80, i / 80});
      const PointSet all = points_in(pattern, run);
      std::map<std::pair<double, double>, std::uint32_t> uses;
      for (std::size_t i = 0; i < kPixels; ++i) ++uses[shape(all, i * static_cast<std::size_t>(n))];
      std::vector<std::uint32_t> counts;
      for (const auto& [set, count] : uses) counts.push_back(count);
      CHECK(counts.size() == kBank);
      CHECK(std::abs(z_of_counts(counts)) < 5);
    }
  }

  TEST_CASE("the sets of a bank are those of dart-throwing, and shifting keeps their distances") {
    constexpr int kBank = 5, kN = 16, kK = 100;
    const Pattern pattern(chosen(text(kK, kBank)), kN, {.seed = 8, .trial = 2});
    std::vector<Thrown> sets;
    for (int s = 0; s < kBank; ++s) sets.push_back(thrown(pixel_key(draw_hash(8, 2), {s, 0}), Axis::bank, kN, kK));
    for (int i = 0; i < 200; ++i) {
      const PointSet points = points_in(pattern, {{i, -i}});
      int matches = 0;
      for (const Thrown& t : sets)
        if (shape(t.set, 0) == shape(points, 0)) {
          ++matches;
          CHECK(least_distance(points) >= t.radius - 1e-15);  // the shift rounds coordinates by 2^-53
        }
      CHECK(matches == 1);
    }
  }

  TEST_CASE("bank = 0 makes a new set in every pixel") {
    const Pattern pattern(chosen(text(50, 0)), 2, {});
    std::map<std::pair<double, double>, int> uses;
    for (int i = 0; i < 500; ++i) ++uses[shape(points_in(pattern, {{i, 0}}), 0)];
    CHECK(uses.size() == 500);
  }

  TEST_CASE("threads that ask for the same sets at once get what one thread gets") {
    for (const int bank : {0, 8}) {
      std::vector<Pixel> run;
      for (int i = 0; i < 40; ++i) run.push_back({i, 1});
      const PatternChoice choice = chosen(text(100, bank));
      const PointSet alone = points_in(Pattern(choice, 16, {}), run);
      const Pattern shared(choice, 16, {});
      std::vector<PointSet> got(4);
      std::vector<std::thread> threads;
      for (PointSet& mine : got) threads.emplace_back([&] { mine = points_in(shared, run); });
      for (std::thread& thread : threads) thread.join();
      for (const PointSet& mine : got) CHECK(mine == alone);
    }
  }

  TEST_CASE("a bank that would be too large is refused with the largest that is not") {
    CHECK_THROWS_WITH_AS(Pattern(chosen("dart-throwing"), 1 << 20, {}), doctest::Contains("bank=16 or less"), Error);
    CHECK_NOTHROW(Pattern(chosen("dart-throwing:bank=16"), 1 << 20, {}));
    CHECK_NOTHROW(Pattern(chosen("dart-throwing:bank=0"), 1 << 20, {}));
    CHECK_NOTHROW(Pattern(chosen("dart-throwing"), 1 << 18, {}));
  }
}
