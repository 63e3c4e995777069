// Monte Carlo against closed forms, and closed forms of expectations against means over trials. All seeds are fixed;
// each test says how often it would fail for other seeds.
#include "measure/discrepancy/monte_carlo.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include "core/parallel.h"
#include "measure/discrepancy/disk_l2.h"
#include "measure/discrepancy/edge_l2.h"
#include "measure/discrepancy/expected.h"
#include "measure/discrepancy/star_l2.h"
#include "measure/discrepancy/test_lines.h"
#include "patterns/variants.h"

using namespace moire;
using moire::test::PointSet;
using moire::test::set_of;

namespace {

constexpr double kPi = std::numbers::pi;
constexpr LineLaw kLaws[] = {LineLaw::isotropic, LineLaw::printed};

Key key_of(std::uint32_t trial) { return pixel_key(draw_hash(21, trial), {}); }
PointView planar(const PointSet& set) { return {set.x, set.y}; }
PointView spatial(const PointSet& set) { return {set.x, set.y, set.t}; }

struct Mean {
  double mean, error;
};

Mean mean_over_trials(int trials, const std::function<double(std::uint32_t)>& value) {
  double sum = 0, squares = 0;
  for (int t = 0; t < trials; ++t) {
    const double v = value(static_cast<std::uint32_t>(t));
    sum += v;
    squares += v * v;
  }
  const double mean = sum / trials;
  return {mean, std::sqrt((squares / trials - mean * mean) / (trials - 1))};
}

// Deviations in standard errors, of many comparisons.
class Deviations {
 public:
  void add(const std::string& what, double got, double want, double error) {
    CAPTURE(what);
    const double z = (got - want) / error;
    CHECK(std::fabs(z) < 3);
    squares_ += z * z;
    ++count_;
  }
  int count() const { return count_; }
  double mean_square() const { return squares_ / count_; }

 private:
  double squares_ = 0;
  int count_ = 0;
};

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("Monte Carlo over lines is the mean over its lines, with the error of a mean") {
    const PointSet set = set_of("random", 13, {41, 0});
    for (const LineLaw law : kLaws)
      for (const Counted counted : {Counted::all, Counted::without_first})
        for (const int tests : {1, 2, 1023, 1024, 1025, 5000}) {
          double sum = 0, squares = 0;
          for (int i = 0; i < tests; ++i) {
            const TestLine line = test_line(law, key_of(6), static_cast<std::uint64_t>(i));
            double count = 0;
            for (std::size_t p = counted == Counted::all ? 0 : 1; p < 13; ++p)
              count += line.nx * set.x[p] + line.ny * set.y[p] >= line.c ? 1 : 0;
            const double d = count / 13 - area_above(line);
            sum += d * d;
            squares += d * d * d * d;
          }
          const MonteCarlo got = edge_l2_monte_carlo(planar(set), law, tests, key_of(6), counted);
          const double mean = sum / tests;
          CHECK(std::fabs(got.mean_square - mean) < 1e-13 * mean);  // 5,000 roundings of 1e-16
          const double error = tests > 1 ? std::sqrt((squares / tests - mean * mean) / (tests - 1)) : 0;
          CHECK(std::fabs(got.standard_error - error) < 1e-10 * mean);
        }
  }

  TEST_CASE("Monte Carlo over lines that were drawn before gives the same bits") {
    for (const int n : {1, 13, 300}) {
      const PointSet set = set_of("random", n, {42, 0});
      for (const LineLaw law : kLaws)
        for (const int tests : {1, 1024, 3000}) {
          const std::vector<MeasuredLine> lines = measured_lines(law, key_of(9), tests);
          for (const Counted counted : {Counted::all, Counted::without_first}) {
            const MonteCarlo drawn = edge_l2_monte_carlo(planar(set), law, tests, key_of(9), counted);
            const MonteCarlo given = edge_l2_monte_carlo(planar(set), lines, counted);
            CHECK(given.mean_square == drawn.mean_square);
            CHECK(given.standard_error == drawn.standard_error);
          }
        }
    }
  }

  TEST_CASE("Monte Carlo gives the same bits for any number of threads") {
    const PointSet set = set_of("zaremba", 50);
    const auto all = [&] {
      std::vector<double> numbers;
      for (const MonteCarlo& m :
           {star_l2_monte_carlo(planar(set), 10000, key_of(7)), star_l2_monte_carlo(spatial(set), 10000, key_of(7)),
            edge_l2_monte_carlo(planar(set), LineLaw::isotropic, 10000, key_of(7)),
            edge_l2_monte_carlo(planar(set), LineLaw::printed, 10000, key_of(7)),
            disk_l2_monte_carlo(planar(set), {}, 10000, key_of(7)),
            disk_l2_monte_carlo(planar(set), 0.3, 10000, key_of(7))}) {
        numbers.push_back(m.mean_square);
        numbers.push_back(m.standard_error);
      }
      return numbers;
    };
    std::vector<double> one;
    {
      const ThreadLimit limit(1);
      one = all();
    }
    const ThreadLimit limit(4);
    CHECK(all() == one);
  }

  TEST_CASE("without the first of one point nothing is counted and only the area's square is left") {
    // Six comparisons within 3 standard errors: fails for one seed in 60.
    const PointSet set = set_of("random", 1, {42, 0});
    const PointSet timed{set.x, set.y, {0.5}};
    constexpr int kTests = 200000;
    const Counted none = Counted::without_first;
    Deviations all;
    const auto add = [&](const char* what, const MonteCarlo& m, double want) {
      all.add(what, m.mean_square, want, m.standard_error);
    };
    add("boxes", star_l2_monte_carlo(planar(set), kTests, key_of(8), none), 1.0 / 9);
    add("boxes in space", star_l2_monte_carlo(spatial(timed), kTests, key_of(8), none), 1.0 / 27);
    add("disks", disk_l2_monte_carlo(planar(set), {}, kTests, key_of(8), none), kPi * kPi / 80);
    // A fixed disk has the same area every time.
    const MonteCarlo fixed = disk_l2_monte_carlo(planar(set), 0.4, 1000, key_of(8), none);
    CHECK(std::fabs(fixed.mean_square - kPi * kPi * 0.4 * 0.4 * 0.4 * 0.4) < 1e-15);
    CHECK(fixed.standard_error < 1e-15);
    // The mean of the square of an area is the mean chance that both of two points are in it; they are on one side of a
    // line unless it separates them, and which side is even.
    const double apart[] = {0.52140543316472067833 / 2, 0.25856738518752638724};
    for (const LineLaw law : kLaws)
      add("lines", edge_l2_monte_carlo(planar(set), law, kTests, key_of(8), none),
          (1 - apart[static_cast<std::size_t>(law)]) / 2);
    // Two points at the origin, of which one is counted: (1/2 - x y)^2 has the mean 1/4 - 1/4 + 1/9.
    const PointSet twins{{0, 0}, {0, 0}};
    add("half", star_l2_monte_carlo(planar(twins), kTests, key_of(9), none), 1.0 / 9);
  }

  TEST_CASE("expected squares have their limits and known values") {
    const auto close = [](double got, double want) { return std::fabs(got / want - 1) < 1e-14; };
    for (const LineLaw law : kLaws) {
      // One point is one point, whatever the pattern's name.
      CHECK(close(expected_edge_l2_squared_jittered(1, law), expected_edge_l2_squared_random(1, law)));
      CHECK(close(expected_edge_l2_squared_n_rooks(1, law), expected_edge_l2_squared_random(1, law)));
    }
    CHECK(close(expected_star_l2_squared_n_rooks(1), expected_star_l2_squared_random(1, 2)));
    for (const int dims : {2, 3})
      CHECK(close(expected_star_l2_squared_jittered(1, dims), expected_star_l2_squared_random(1, dims)));
    // Known to 17 digits from exact arithmetic.
    CHECK(close(expected_star_l2_squared_jittered(16), 0.0024956597222222222));
    CHECK(close(expected_star_l2_squared_jittered(1600), 2.5933159722222222e-6));
    CHECK(close(expected_star_l2_squared_n_rooks(16), 0.0022718641493055556));
    CHECK(close(expected_star_l2_squared_n_rooks(1600), 1.7415357801649306e-5));
    CHECK(close(expected_edge_l2_squared_jittered(256, LineLaw::isotropic), 3.1824062082807659e-5));
    CHECK(close(std::sqrt(1600 * expected_edge_l2_squared_random(1600, LineLaw::isotropic)), 0.36104204504625243));
    CHECK(close(std::sqrt(1600 * expected_edge_l2_squared_random(1600, LineLaw::printed)), 0.35956041577704740));
    CHECK(close(std::sqrt(7 * expected_disk_l2_squared_random(7, {})), 0.37206092617410452));
    // N-rooks of very many points cost 2 R - S over 2 N, R the mean chance of separation of two points of a line of
    // length 1: 1/6 for either law. What is left out is (R - S / 2) / N and terms of order (log N) / N^2.
    const double apart[] = {0.52140543316472067833 / 2, 0.25856738518752638724};
    for (const LineLaw law : kLaws)
      for (const std::int64_t n : {100000, 10000000})
        CHECK(std::fabs(2.0 * static_cast<double>(n) * expected_edge_l2_squared_n_rooks(n, law) -
                        (1.0 / 3 - apart[static_cast<std::size_t>(law)])) < 1.0 / static_cast<double>(n));
  }
}

TEST_SUITE("heavy") {
  TEST_CASE("the mean over 1,000 draws of random, jittered and N-rooks points is the expected square") {
    // 28 comparisons within 3 standard errors: fails for one seed in 14.
    constexpr int kTrials = 1000;
    Deviations all;
    for (const int n : {16, 64}) {
      const auto mean = [&](const std::string& pattern, const auto& measure, double want, const std::string& what) {
        const Mean m = mean_over_trials(kTrials, [&](std::uint32_t t) { return measure(set_of(pattern, n, {51, t})); });
        all.add(pattern + " " + what + " " + std::to_string(n), m.mean, want, m.error);
      };
      const auto star = [](const PointSet& set) { return star_l2_squared(planar(set)); };
      const auto star3 = [](const PointSet& set) { return star_l2_squared(spatial(set)); };
      mean("random", star, expected_star_l2_squared_random(n, 2), "star");
      mean("random", star3, expected_star_l2_squared_random(n, 3), "star in space");
      mean("jittered", star, expected_star_l2_squared_jittered(n), "star");
      mean("jittered-random-time", star3, expected_star_l2_squared_jittered(n, 3), "star in space");
      mean("n-rooks", star, expected_star_l2_squared_n_rooks(n), "star");
      for (const LineLaw law : kLaws) {
        const auto edge = [law](const PointSet& set) { return edge_l2_squared(planar(set), law); };
        mean("random", edge, expected_edge_l2_squared_random(n, law), "edge");
        mean("jittered", edge, expected_edge_l2_squared_jittered(n, law), "edge");
        mean("n-rooks", edge, expected_edge_l2_squared_n_rooks(n, law), "edge");
      }
      const auto disk = [](const PointSet& set) { return disk_l2_squared(planar(set)); };
      mean("random", disk, expected_disk_l2_squared_random(n, {}), "disk");
      for (const double radius : {0.2, 0.5}) {
        const auto fixed = [radius](const PointSet& set) { return disk_l2_squared(planar(set), radius); };
        mean("random", fixed, expected_disk_l2_squared_random(n, radius), "disk of one size");
      }
    }
    MESSAGE(all.count(), " comparisons, mean square deviation ", all.mean_square(), " standard errors");
  }

  TEST_CASE("closed forms are what Monte Carlo finds for every pattern of the catalogue") {
    // Of 59 comparisons one is beyond 3 standard errors for one seed in 7. Such a one is repeated, once, with fresh
    // tests and 16 times as many of them, and has to be within 3 then: an error that showed at first is four times as
    // many standard errors there, and chance alone fails one seed in 2,000. The mean square of the first deviations has
    // to be about 1, too: the tests of each pattern are its own.
    constexpr std::int64_t kTests = 200000;
    int count = 0;
    double squares = 0;
    std::uint32_t number = 100;
    for (const PatternInfo* info : patterns()) {
      const std::string name(info->name);
      const std::vector<std::string> known = test::variants();
      if (std::find(known.begin(), known.end(), name) == known.end()) continue;  // needs a file
      const PointSet set = set_of(name, test::usable(test::chosen(name), 36), {61, number});
      const Key key = key_of(number), fresh = key_of(1000 + number);
      ++number;
      const auto compare = [&](const std::string& what, double closed, const auto& monte_carlo) {
        CAPTURE(name);
        CAPTURE(what);
        const auto deviation = [&](std::int64_t tests, const Key& k) {
          const MonteCarlo m = monte_carlo(tests, k);
          return (m.mean_square - closed) / m.standard_error;
        };
        const double z = deviation(kTests, key);
        CHECK((std::fabs(z) < 3 || std::fabs(deviation(16 * kTests, fresh)) < 3));
        squares += z * z;
        ++count;
      };
      compare("star", star_l2_squared(planar(set)),
              [&](auto tests, const Key& k) { return star_l2_monte_carlo(planar(set), tests, k); });
      if (!set.t.empty())
        compare("star in space", star_l2_squared(spatial(set)),
                [&](auto tests, const Key& k) { return star_l2_monte_carlo(spatial(set), tests, k); });
      for (const LineLaw law : kLaws)
        compare("edge", edge_l2_squared(planar(set), law),
                [&](auto tests, const Key& k) { return edge_l2_monte_carlo(planar(set), law, tests, k); });
      compare("disk", disk_l2_squared(planar(set)),
              [&](auto tests, const Key& k) { return disk_l2_monte_carlo(planar(set), {}, tests, k); });
      for (const double radius : {0.2, 0.45})
        compare("disk of one size", disk_l2_squared(planar(set), radius),
                [&](auto tests, const Key& k) { return disk_l2_monte_carlo(planar(set), radius, tests, k); });
    }
    MESSAGE(count, " comparisons, mean square deviation ", squares / count, " standard errors");
    CHECK(count >= 50);
    CHECK(std::fabs(squares / count - 1) < 4 * std::sqrt(2.0 / count));
  }
}
