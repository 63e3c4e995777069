// Sampled images under radial filters: what the definition's double sum gives, and all that holds of separable ones.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "catalogue.h"
#include "core/hash.h"
#include "core/parallel.h"
#include "engine/cell_sums.h"
#include "engine/exact.h"
#include "engine/render.h"
#include "engine/skipping.h"

using namespace moire;
using namespace moire::test;

namespace {

constexpr Estimator kShared[] = {Estimator::ratio, Estimator::unnormalised, Estimator::control_variate};
constexpr long double kUnit = 0x1p-53L;

Filter filter_of(const std::string& text) { return Filter(parse_spec(text, "test")); }

// With the count itself or the next that the pattern can have.
Pattern pattern_of(const char* text, int n, Draw draw = {3, 1}) {
  const PatternChoice choice(parse_spec(text, "test"));
  return {choice, choice.info().counts(choice.args(), n).above, draw};
}

// An image's definition, sample by sample: no cells, no bands, no weights remembered.
class DoubleSum {
 public:
  struct Value {
    long double k = 0, kf = 0;                     // sums over the window
    long double error = 0;                         // bound on what the program's may differ from either
    std::int64_t own_samples = 0, own_inside = 0;  // of the pixel's own samples in its window, the square
  };

  DoubleSum(const TestImage& scene, const Pattern& pattern, const Filter& filter)
      : scene_(scene), pattern_(pattern), filter_(filter) {}

  Value operator()(int px, int py) const {
    const RadialKernel& kernel = filter_.radial_kernel();
    const auto n = static_cast<std::size_t>(pattern_.n());
    const int reach = filter_.apron();
    std::vector<double> x(n), y(n);
    std::vector<std::uint8_t> inside(n);
    Value sum;
    long double absolute = 0, weights = 0;
    for (int dy = -reach; dy <= reach; ++dy) {
      for (int dx = -reach; dx <= reach; ++dx) {
        const Pixel cell{px + dx, py + dy};
        pattern_.fill({&cell, 1}, {x, y});
        scene_.contains({&cell, 1}, x, y, inside);
        for (std::size_t i = 0; i < n; ++i) {
          const double ox = x[i] + (dx - 0.5), oy = y[i] + (dy - 0.5), r = filter_.radius();
          if (dx == 0 && dy == 0 && ox >= -r && ox < r && oy >= -r && oy < r) {
            ++sum.own_samples;
            sum.own_inside += inside[i];
          }
          const auto distance =
              static_cast<double>(std::hypot(static_cast<long double>(ox), static_cast<long double>(oy)));
          const auto w = static_cast<long double>(kernel.k(distance));
          sum.k += w;
          sum.kf += inside[i] != 0 ? w : 0;
          absolute += std::fabs(w);
          weights += distance < r ? 1 : 0;
        }
      }
    }
    // Both distances are right to 2 u: what that does to k, and twice what k errs by. A sum adds no weight more often
    // than there are samples in a cell and cells.
    const auto cells = static_cast<long double>((2 * reach + 1) * (2 * reach + 1));
    const auto slope = static_cast<long double>(kernel.slope_max() * kernel.radius());
    sum.error = weights * (4 * kUnit * slope + 2 * static_cast<long double>(kernel.k_error())) +
                1.01L * (static_cast<long double>(n) + cells) * kUnit * absolute;
    return sum;
  }

 private:
  const TestImage& scene_;
  const Pattern& pattern_;
  const Filter& filter_;
};

// Pixels of the exhaustive image that are not what the sums say, within what rounding may do.
int wrong_pixels(const TestImage& scene, const Pattern& pattern, const Filter& filter, Estimator estimator) {
  const ActiveRows rows = enumerate(scene, filter.radius());
  const Rendered all = render(scene, pattern, filter, estimator, rows, true);
  const DoubleSum sums(scene, pattern, filter);
  const auto rho = static_cast<long double>(pattern.n());
  int wrong = 0;
  std::int64_t fallbacks = 0;
  for_each_rendered(rows, all, [&](int x, int y, Cover cover, double got) {
    const DoubleSum::Value s = sums(x, y);
    long double want = 0, bound = 0;
    const bool fallback = estimator == Estimator::ratio && s.k < rho / 4;
    if (estimator == Estimator::unnormalised) {
      want = s.kf / rho;
      bound = s.error / rho;
    } else if (estimator == Estimator::ratio && !fallback) {
      want = s.kf / s.k;
      bound = s.error * (1 + std::fabs(want)) / (s.k - s.error);
    } else {
      const Pixel pixel{x, y};
      const double half = 0.5;
      std::uint8_t inside = 0;
      scene.contains({&pixel, 1}, {&half, 1}, {&half, 1}, {&inside, 1});
      const long double mean =
          s.own_samples > 0 ? static_cast<long double>(s.own_inside) / static_cast<long double>(s.own_samples) : inside;
      want = mean + (s.kf - mean * s.k) / rho;
      // The mean, its product, the difference, the quotient and the sum: five roundings of numbers up to these.
      bound = 2 * s.error / rho + 5 * kUnit * (1 + (std::fabs(s.kf) + std::fabs(s.k)) / rho);
    }
    bound += 2 * kUnit * std::fabs(want);
    wrong += !(std::fabs(static_cast<long double>(got) - want) <= bound);
    fallbacks += fallback && cover == Cover::partial;
  });
  return wrong + (all.fallbacks != fallbacks);
}

// RMSE over active pixels and a few trials.
double rmse(const TestImage& scene, const ActiveRows& rows, const Reference& truth, const Filter& filter, int spp) {
  double sum = 0, count = 0;
  for (std::uint32_t trial = 0; trial < 8; ++trial) {
    const Rendered r = render(scene, pattern_of("jittered", spp, {1, trial}), filter, Estimator::ratio, rows);
    for (std::size_t i = 0; i < r.value.size(); ++i) {
      const double error = r.value[i] - truth.value[i];
      sum += error * error;
      count += 1;
    }
  }
  return std::sqrt(sum / count);
}

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("every radial filter gives what the double sum over samples gives, by every estimator") {
    const TestImage scene = scenes::disk({3.3, 2.7}, 2.1, {6, 5});
    for (const std::string& text : radial_texts()) {
      const Filter filter = filter_of(text);
      for (const char* name : {"jittered", "zaremba"}) {
        for (const int n : {1, 4, 17}) {
          const Pattern pattern = pattern_of(name, n);
          for (const Estimator estimator : kShared) {
            CAPTURE(text);
            CAPTURE(std::string(name));
            CAPTURE(n);
            CAPTURE(std::string(name_of(estimator)));
            CHECK(wrong_pixels(scene, pattern, filter, estimator) == 0);
          }
        }
      }
    }
  }

  TEST_CASE("so do many samples: whole chunks of them and what is left") {
    const TestImage scene = scenes::edge({2.3, 1.7}, 97.3, {4, 3});
    for (const char* text : {"disk", "radial-gaussian:sigma=0.1,radius=0.3", "radial-bc", "jinc"}) {
      const Filter filter = filter_of(text);
      for (const char* name : {"jittered", "zaremba", "random"}) {
        for (const int n : {256, 1300}) {
          const Pattern pattern = pattern_of(name, n);
          for (const Estimator estimator : kShared) {
            CAPTURE(std::string(text));
            CAPTURE(std::string(name));
            CAPTURE(n);
            CHECK(wrong_pixels(scene, pattern, filter, estimator) == 0);
          }
        }
      }
    }
  }

  TEST_CASE("weights remembered from the cell before change no bit, whichever pixels it needed") {
    const Key key{1, 2};
    for (const char* text : {"disk", "cone", "jinc"}) {
      const Filter filter = filter_of(text);
      const auto side = static_cast<std::size_t>(2 * filter.apron() + 1);
      for (const std::size_t n : {std::size_t{0}, std::size_t{5}, std::size_t{512}, std::size_t{1100}}) {
        std::vector<double> x(n), y(n);
        std::vector<std::uint8_t> inside(n);
        for (std::uint32_t i = 0; i < n; ++i) {
          const Words w = hash(key, i, Axis::shift);
          x[i] = unit(w.a, w.b);
          y[i] = unit(w.c, w.d);
          inside[i] = x[i] > y[i];
        }
        const std::vector<std::uint8_t> every(side * side, 1);
        CellSums used(filter);
        for (std::size_t turn = 0; turn < 4; ++turn) {
          std::vector<std::uint8_t> needed(side * side);
          for (std::size_t p = turn; p < needed.size(); p += turn + 1) needed[p] = 1;
          // Other points, and as many: in y alone, in x alone. In the last turn they are those of the one before.
          if (turn == 1) std::reverse(y.begin(), y.end());
          if (turn == 2) std::reverse(x.begin(), x.end());
          std::vector<WeightSum> sums(side * side), expected(side * side);
          OwnCount own, expected_own;
          used(x, y, inside, needed, sums, own);
          CellSums fresh(filter);
          fresh(x, y, inside, every, expected, expected_own);
          int wrong = own.samples != expected_own.samples || own.inside != expected_own.inside;
          for (std::size_t p = 0; p < needed.size(); ++p) {
            if (needed[p] == 0) continue;
            wrong += !same_bits(sums[p].k, expected[p].k) || !same_bits(sums[p].kf, expected[p].kf);
          }
          CAPTURE(std::string(text));
          CAPTURE(n);
          CHECK(wrong == 0);
        }
      }
    }
  }

  TEST_CASE("a cell's sums mirror with its points, to the last bit") {
    // k(r) has no direction: points mirrored in x, or with x and y exchanged, give the sums of mirrored pixels. Of
    // multiples of 1/64 all distances are the same to the bit, and the order of additions is, too.
    const Key key{5, 6};
    std::vector<double> x(300), y(300), mirrored(300);
    std::vector<std::uint8_t> inside(300);
    for (std::uint32_t i = 0; i < 300; ++i) {
      const Words w = hash(key, i, Axis::shift);
      x[i] = (w.a % 63 + 1) / 64.0;
      y[i] = (w.b % 63 + 1) / 64.0;
      mirrored[i] = 1 - x[i];
      inside[i] = w.c % 2;
    }
    for (const std::string& text : radial_texts()) {
      const Filter filter = filter_of(text);
      const auto side = static_cast<std::size_t>(2 * filter.apron() + 1);
      const std::vector<std::uint8_t> every(side * side, 1);
      std::vector<WeightSum> sums(side * side), in_mirror(side * side), exchanged(side * side);
      OwnCount own;
      CellSums sum(filter);
      sum(x, y, inside, every, sums, own);
      sum(mirrored, y, inside, every, in_mirror, own);
      sum(y, x, inside, every, exchanged, own);
      int wrong = 0;
      for (std::size_t j = 0; j < side; ++j) {
        for (std::size_t i = 0; i < side; ++i) {
          const WeightSum &a = sums[j * side + i], &b = in_mirror[j * side + (side - 1 - i)],
                          &c = exchanged[i * side + j];
          wrong += !same_bits(a.k, b.k) || !same_bits(a.kf, b.kf) || !same_bits(a.k, c.k) || !same_bits(a.kf, c.kf);
        }
      }
      CAPTURE(text);
      CHECK(wrong == 0);
    }
  }

  TEST_CASE("a round Gaussian is the separable one on the same samples, where nothing of either is cut off") {
    // What a cut at 4.5 = 9 sigma leaves out is exp(-40) of the integral, below u of it. The sums of some 81 rho
    // weights then differ by the weights' own errors and by rounding; both estimators divide by rho or nearly that.
    const Filter round = filter_of("radial-gaussian:sigma=0.5,radius=4.5,cut=cut"),
                 square = filter_of("gaussian:sigma=0.5,radius=4.5,cut=cut");
    const double a_weight = round.radial_kernel().k_error() + 2 * square.kernel().k_max() * square.kernel().k_error() +
                            0x1p-53 * round.radial_kernel().k_max();
    for (const auto& named : scene_catalogue({16, 14})) {
      const TestImage& scene = named.second;
      const ActiveRows rows = enumerate(scene, 4.5);
      for (const char* pattern_name : {"jittered", "zaremba"}) {
        const Pattern pattern = pattern_of(pattern_name, 16);
        for (const Estimator estimator : {Estimator::ratio, Estimator::unnormalised}) {
          const Rendered a = render(scene, pattern, round, estimator, rows);
          const Rendered b = render(scene, pattern, square, estimator, rows);
          REQUIRE(a.value.size() == b.value.size());
          CHECK(a.samples_evaluated == b.samples_evaluated);
          double most = 0;
          for (std::size_t i = 0; i < a.value.size(); ++i) most = std::max(most, std::fabs(a.value[i] - b.value[i]));
          CAPTURE(named.first);
          CAPTURE(std::string(pattern_name));
          // A ratio has two such sums, and a weight sum down to a quarter of rho.
          CHECK(most <= 2 * 4 * 81 * 2 * a_weight);
        }
      }
    }
  }

  TEST_CASE("jittered errors fall as the number of samples to -3/4, as they do under separable filters") {
    const TestImage scene = scenes::edge({16.3, 15.1}, 97.3, {32, 32});
    for (const char* text : {"tent", "disk", "cone", "radial-gaussian", "radial-bc", "radial-lanczos", "jinc"}) {
      const Filter filter = filter_of(text);
      const ActiveRows rows = enumerate(scene, filter.radius());
      const Reference truth = exact(scene, filter, rows);
      const double exponent =
          std::log(rmse(scene, rows, truth, filter, 16) / rmse(scene, rows, truth, filter, 256)) / std::log(16.0);
      CAPTURE(std::string(text));
      CAPTURE(exponent);
      // The error's mean square comes from some 250 independent pieces of the edge, 32 rows in 8 trials, and so is
      // right to a tenth: the exponent to sqrt(2) 0.05 / log 16 = 0.025, of which three are allowed.
      CHECK(std::fabs(exponent - 0.75) < 0.075);
    }
  }

  TEST_CASE("skipping changes no bit: radial filters, patterns that vary and that do not") {
    const TestImage scenes[] = {scenes::disk({8.7, 7.2}, 4.25, {18, 15}), scenes::edge({8, 0}, 180, {18, 15})};
    for (const char* text :
         {"disk", "radial-gaussian:sigma=0.1,radius=0.3", "cone", "radial-bc:b=1.5,c=-0.25", "jinc"}) {
      for (const TestImage& scene : scenes) {
        for (const char* name : {"random", "jittered", "zaremba"}) {
          for (const int n : {1, 4}) check_skipping(scene, pattern_of(name, n), filter_of(text), kShared);
        }
      }
    }
  }

  TEST_CASE("one, two and three threads give the same bits under radial filters") {
    const TestImage scene = scenes::disk({15.7, 14.2}, 9.25, {32, 28});
    for (const std::string& text : radial_texts()) {
      const Filter filter = filter_of(text);
      const ActiveRows rows = enumerate(scene, filter.radius());
      for (const char* name : {"jittered", "zaremba"}) {
        const Pattern pattern = pattern_of(name, 9);
        const auto run = [&](int threads) {
          const ThreadLimit limit(threads);
          return render(scene, pattern, filter, Estimator::ratio, rows);
        };
        const Rendered one = run(1);
        for (const int threads : {2, 3}) {
          const Rendered other = run(threads);
          CAPTURE(text);
          CAPTURE(std::string(name));
          CHECK(std::equal(one.value.begin(), one.value.end(), other.value.begin(), other.value.end(), same_bits));
          CHECK(one.fallbacks == other.fallbacks);
          CHECK(one.samples_evaluated == other.samples_evaluated);
        }
      }
    }
  }
}

// Too slow under sanitizers.
TEST_SUITE("heavy") {
  // Patterns, counts and layouts take turns, so that each filter meets them all over the scenes.
  TEST_CASE("skipping changes no bit: every radial filter on every scene") {
    const std::vector<PatternChoice> choices = pattern_catalogue();
    std::size_t turn = 0;
    for (const std::string& text : radial_texts()) {
      const Filter filter = filter_of(text);
      for (const auto& named : scene_catalogue()) {
        const TestImage& scene = named.second;
        for (int i = 0; i < 2; ++i, ++turn) {
          const PatternChoice& choice = choices[turn % choices.size()];
          const int n = turn / choices.size() % 2 == 0 ? 4 : 1;
          CAPTURE(choice.text());
          CAPTURE(named.first);
          check_skipping(scene, Pattern(choice, n, {7, 3}), filter, kShared);
          if (choice.info().area_count == nullptr) continue;
          check_skipping(scene, AreaPoints(choice, scene.grid(), filter.apron(), n, {7, 3}), filter, kShared);
        }
      }
      ++turn;
    }
  }
}
