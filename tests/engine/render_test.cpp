// Sampled images: skipping and threads change no bit, over the whole catalogue; and the error has the law it must have.
#include <doctest/doctest.h>

#include <cmath>
#include <vector>

#include "catalogue.h"
#include "core/error.h"
#include "core/parallel.h"
#include "core/sum.h"
#include "engine/exact.h"
#include "engine/render.h"
#include "engine/skipping.h"

using namespace moire;
using namespace moire::test;

namespace {

bool same(const Rendered& a, const Rendered& b) {
  if (a.value.size() != b.value.size() || a.fallbacks != b.fallbacks || a.samples_evaluated != b.samples_evaluated) {
    return false;
  }
  for (std::size_t i = 0; i < a.value.size(); ++i) {
    if (!same_bits(a.value[i], b.value[i])) return false;
  }
  return true;
}

// Kernels of one to seven cells, smooth and not, with and without negative lobes.
std::vector<Filter> narrow_and_wide_filters() {
  std::vector<Filter> filters;
  for (const char* text : {"box", "box:width=0.5", "tent", "mitchell", "gaussian", "lanczos"}) {
    filters.emplace_back(parse_spec(text, "test"));
  }
  return filters;
}

void check_skipping(const TestImage& scene, Samples samples, const Filter& filter) {
  std::vector<Estimator> estimators;
  for (const std::string_view name : estimator_names()) {
    const Estimator estimator = find_estimator(name, "test");
    if (is_importance(estimator) && samples.pattern() == nullptr) continue;  // has samples for each pixel alone
    estimators.push_back(estimator);
  }
  test::check_skipping(scene, samples, filter, estimators);
}

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("a sample on the edge x = 256 of normal 180 is inside, and pixel 256 is not skipped") {
    // Hammersley's first point is x = 0: in pixel 256 it lies on the line itself, so one sample of n is inside.
    const TestImage scene = scenes::edge({256, 0}, 180, {512, 4});
    const Filter box(parse_spec("box", "test"));
    const ActiveRows rows = enumerate(scene, box.radius());
    const Pattern pattern(PatternChoice(parse_spec("hammersley", "test")), 16, {});
    const Rendered some = render(scene, pattern, box, Estimator::ratio, rows);
    const Rendered all = render(scene, pattern, box, Estimator::ratio, rows, true);
    CHECK(differences(some, all, rows) == 0);
    CHECK(all.value[255] == 1.0);
    CHECK(all.value[256] == 1.0 / 16);
    CHECK(all.value[257] == 0.0);
  }

  TEST_CASE("scenes whose boundary lies within a few ulp of samples are skipped without a difference") {
    const Filter box(parse_spec("box", "test")), tent(parse_spec("tent", "test"));
    for (int ulps = -4; ulps <= 4; ++ulps) {
      double x = 24;
      for (int i = 0; i < std::abs(ulps); ++i) x = std::nextafter(x, ulps > 0 ? 100 : 0);
      CAPTURE(ulps);
      const TestImage scenes_near[] = {scenes::edge({x, 0}, 180, {48, 8}), scenes::edge({x + 0.25, 0}, 0, {48, 8}),
                                       scenes::disk({x - 5, 4}, 5, {48, 8}), scenes::disk({x + 5.5, 4}, 5, {48, 8})};
      for (const TestImage& scene : scenes_near) {
        for (const Filter* filter : {&box, &tent}) {
          const ActiveRows rows = enumerate(scene, filter->radius());
          const Pattern pattern(PatternChoice(parse_spec("hammersley", "test")), 4, {});
          CHECK(differences(render(scene, pattern, *filter, Estimator::ratio, rows),
                            render(scene, pattern, *filter, Estimator::ratio, rows, true), rows) == 0);
        }
      }
    }
  }

  TEST_CASE("a cut-out of a scene has the same values as the whole image there") {
    // The same geometry, seen from an image whose origin is elsewhere: patterns draw by absolute pixel, so only those
    // without a draw are compared.
    const TestImage whole = scenes::disk({23.5, 20.25}, 14.25, {48, 40}),
                    part = scenes::disk({23.5, 10.25}, 14.25, {48, 30});
    const Pattern pattern(PatternChoice(parse_spec("zaremba", "test")), 16, {});
    for (const Filter& filter : filter_catalogue()) {
      const ActiveRows a = enumerate(whole, filter.radius()), b = enumerate(part, filter.radius());
      const Rendered all = render(whole, pattern, filter, Estimator::ratio, a, true);
      const Rendered cut = render(part, pattern, filter, Estimator::ratio, b, true);
      int different = 0;
      for (std::size_t i = 0; i < cut.value.size(); ++i) different += !same_bits(cut.value[i], all.value[i + 10 * 48]);
      CHECK(different == 0);
    }
  }

  TEST_CASE("with vanishing weight sums the control variate stands in, counted, and flat windows stay exact") {
    // One sample per pixel and negative lobes: some weight sums fall below a quarter of what they should be.
    const TestImage scene = scenes::disk({24.13, 23.9}, 15.3, {48, 48});
    const Filter filter(parse_spec("catmull-rom", "test"));
    const ActiveRows rows = enumerate(scene, filter.radius());
    std::int64_t fallbacks = 0;
    for (std::uint32_t trial = 0; trial < 8; ++trial) {
      const Pattern pattern(PatternChoice(parse_spec("random", "test")), 1, {1, trial});
      const Rendered r = render(scene, pattern, filter, Estimator::ratio, rows);
      fallbacks += r.fallbacks;
      // sum k f / sum k with sum k >= rho / 4, or mean + (...) / rho: both bounded by 4 sum |k| / rho, |k| <= 1.16^2,
      // 25 cells.
      for (const double v : r.value) CHECK(std::fabs(v) <= 4 * 25 * 1.35);
    }
    CHECK(fallbacks > 0);
    // Own samples outside a window of half a pixel: the scene at the centre stands in.
    const Filter narrow(parse_spec("box:width=0.0625", "test"));
    const ActiveRows narrow_rows = enumerate(scene, narrow.radius());
    const Pattern one(PatternChoice(parse_spec("random", "test")), 1, {1, 0});
    const Rendered r = render(scene, one, narrow, Estimator::ratio, narrow_rows, true);
    for (const double v : r.value) CHECK((v == 0 || v == 1));
    CHECK(r.fallbacks > 0);
  }

  TEST_CASE("a 4096 x 4096 edge needs less than a thousandth of its samples") {
    const TestImage scene = scenes::edge({2048.3, 2047.1}, 97.3, {4096, 4096});
    const Filter box(parse_spec("box", "test"));
    const ActiveRows rows = enumerate(scene, box.radius());
    const Pattern pattern(PatternChoice(parse_spec("jittered", "test")), 4, {});
    const Rendered r = render(scene, pattern, box, Estimator::ratio, rows);
    CHECK(r.samples_total == std::int64_t{4} * 4096 * 4096);
    CHECK(static_cast<double>(r.samples_evaluated) < 1e-3 * static_cast<double>(r.samples_total));
  }

  TEST_CASE("estimators have names, and unknown ones are refused with the known") {
    for (const std::string_view name : estimator_names()) CHECK_NOTHROW(find_estimator(name, "test"));
    CHECK_THROWS_AS(find_estimator("ratoi", "test"), Error);
  }
}

TEST_SUITE("unit") {
  // Of n independent samples in a pixel of exact coverage A the number inside is binomial: err^2 has mean A (1 - A) / n
  // and variance (m4 - m2^2), m4 the binomial's fourth central moment over n^4. The pooled z over many pixels and
  // trials is standard normal up to the sum's own skewness; |z| < 4 has a false-alarm rate of 6e-5 at a fixed seed.
  TEST_CASE("random points: the squared error of box pixels has the binomial's mean") {
    const Filter box(parse_spec("box", "test"));
    for (const auto& [name, scene] : {std::pair{"edge", scenes::edge({128.3, 127.1}, 97.3, {256, 256})},
                                      std::pair{"disk", scenes::disk({127.7, 128.3}, 100.25, {256, 256})}}) {
      const ActiveRows rows = enumerate(scene, box.radius());
      const Reference truth = exact(scene, box, rows);
      for (const int n : {1, 4, 16}) {
        Sum excess, variance;
        for (std::uint32_t trial = 0; trial < 64; ++trial) {
          const Pattern pattern(PatternChoice(parse_spec("random", "test")), n, {1, trial});
          const Rendered r = render(scene, pattern, box, Estimator::ratio, rows);
          for (std::size_t i = 0; i < r.value.size(); ++i) {
            const double a = std::fmin(std::fmax(truth.value[i], 0), 1), q = a * (1 - a);
            const double m2 = q / n, m4 = (3 * q * q * (n - 2) + q) / (double(n) * n * n);
            const double error = r.value[i] - truth.value[i];
            excess.add(error * error - m2);
            variance.add(m4 - m2 * m2);
          }
        }
        const double z = excess.value() / std::sqrt(variance.value());
        CAPTURE(name);
        CAPTURE(n);
        CAPTURE(z);
        CHECK(std::fabs(z) < 4);
      }
    }
  }

  // Samples independent and uniform over the cells that a window touches: the un-normalised estimator's mean is the
  // exact value whatever the kernel's lobes do. Pixels share samples only over a few neighbours, so trials are the
  // clusters: the mean over trials of the image's mean error, in units of its own standard error, is Student's t with
  // 255 degrees of freedom; 4.2 has a false-alarm rate of 4e-5.
  TEST_CASE("random points: the un-normalised estimator is unbiased, on flat windows too") {
    const TestImage scene = scenes::disk({15.7, 14.2}, 9.25, {32, 28});
    for (const char* text : {"tent", "catmull-rom", "lanczos"}) {
      const Filter filter(parse_spec(text, "test"));
      const ActiveRows rows = enumerate(scene, filter.radius());
      const Reference truth = exact(scene, filter, rows);
      constexpr int kTrials = 256;
      double sum = 0, sum_sq = 0;
      for (std::uint32_t trial = 0; trial < kTrials; ++trial) {
        const Pattern pattern(PatternChoice(parse_spec("random", "test")), 4, {5, trial});
        const Rendered r = render(scene, pattern, filter, Estimator::unnormalised, rows);
        double total = 0;
        std::size_t active = 0;
        for_each_rendered(rows, r, [&](int, int, Cover cover, double value) {
          total += value - (cover == Cover::all ? 1.0 : truth.value[active++]);
        });
        sum += total;
        sum_sq += total * total;
      }
      const double mean = sum / kTrials, variance = (sum_sq - sum * mean) / (kTrials - 1);
      CAPTURE(text);
      CHECK(std::fabs(mean) <= 4.2 * std::sqrt(variance / kTrials));
      CHECK(variance > 0);
    }
  }

  TEST_CASE("the control variate is near the ratio, and exact on flat windows") {
    const TestImage scene = scenes::disk({15.7, 14.2}, 9.25, {32, 28});
    const Filter filter(parse_spec("mitchell", "test"));
    const ActiveRows rows = enumerate(scene, filter.radius());
    const Reference truth = exact(scene, filter, rows);
    const Pattern pattern(PatternChoice(parse_spec("jittered", "test")), 64, {1, 0});
    const auto mean_square = [&](Estimator e) {
      const Rendered r = render(scene, pattern, filter, e, rows);
      CHECK(r.pixels == Pixels::active);
      CHECK(r.fallbacks == 0);
      double sum = 0;
      for (std::size_t i = 0; i < r.value.size(); ++i)
        sum += (r.value[i] - truth.value[i]) * (r.value[i] - truth.value[i]);
      return sum;
    };
    // Both lose what the other loses, to first order in the weight sum's noise: within a factor of 1.5 in square here.
    const double a = mean_square(Estimator::ratio), b = mean_square(Estimator::control_variate);
    CHECK(a < 1.5 * b);
    CHECK(b < 1.5 * a);
  }
}

TEST_SUITE("unit") {
  TEST_CASE("a set over the whole image gives what summing over all its points gives") {
    const PatternChoice choice(parse_spec("random", "test"));
    for (const Filter& filter : narrow_and_wide_filters()) {
      CAPTURE(filter.text());
      const TestImage scene = scenes::disk({9.7, 8.2}, 5.25, {20, 16});
      const ActiveRows rows = enumerate(scene, filter.radius());
      const AreaPoints points(choice, scene.grid(), filter.apron(), 1, {5, 0});
      const double rho = points.density();
      const Rendered ratio = render(scene, points, filter, Estimator::ratio, rows);
      const Rendered sum = render(scene, points, filter, Estimator::unnormalised, rows, true);
      std::int64_t fallbacks = 0;
      std::size_t next = 0;
      for_each_rendered(rows, sum, [&](int px, int py, Cover cover, double value) {
        double k = 0, kf = 0, own = 0, own_inside = 0;
        for (int y = -filter.apron(); y < 16 + filter.apron(); ++y) {
          const auto row = points.points(-filter.apron(), 20 + filter.apron(), y);
          for (int x = -filter.apron(); x < 20 + filter.apron(); ++x) {
            const auto at = static_cast<std::size_t>(x + filter.apron());
            for (std::size_t i = row.first[at]; i < row.first[at + 1]; ++i) {
              const double gx = x + row.x[i], gy = y + row.y[i];
              const double f = std::hypot(gx - 9.7, gy - 8.2) <= 5.25 ? 1 : 0;
              const double dx = gx - (px + 0.5), dy = gy - (py + 0.5), r = filter.radius();
              const double w = filter.kernel().k(dx) * filter.kernel().k(dy);
              k += w;
              kf += w * f;
              if (x != px || y != py || dx < -r || dx >= r || dy < -r || dy >= r) continue;
              own += 1;
              own_inside += f;
            }
          }
        }
        // A few dozen additions of numbers below 4, in another order.
        CHECK(std::fabs(value - kf / rho) < 1e-13);
        if (cover != Cover::partial) return;
        double expected = kf / k;
        if (k < rho / 4) {
          const double center = std::hypot(px + 0.5 - 9.7, py + 0.5 - 8.2) <= 5.25 ? 1 : 0;
          const double mean = own > 0 ? own_inside / own : center;
          expected = mean + (kf - mean * k) / rho;
          ++fallbacks;
        }
        CHECK(std::fabs(ratio.value[next++] - expected) < 1e-12);
      });
      CHECK(ratio.fallbacks == fallbacks);
      CHECK(ratio.samples_total == points.count());
      CHECK(ratio.samples_evaluated < points.count());
      CHECK(sum.samples_evaluated == points.count());
    }
  }
}

// Too slow under sanitizers.
TEST_SUITE("heavy") {
  TEST_CASE("skipping changes no bit: every pattern on every scene, with few and more samples") {
    const std::vector<Filter> filters = narrow_and_wide_filters();
    for (const PatternChoice& choice : pattern_catalogue()) {
      for (const int n : {1, 4}) {
        const Pattern pattern(choice, n, {7, 3});
        for (const auto& [name, scene] : scene_catalogue()) {
          CAPTURE(choice.text());
          CAPTURE(name);
          for (const Filter& filter : filters) check_skipping(scene, pattern, filter);
        }
      }
    }
  }

  // Patterns and counts take turns, so that each filter meets them all over the scenes.
  TEST_CASE("skipping changes no bit: every filter on every scene") {
    const std::vector<PatternChoice> choices = pattern_catalogue();
    std::size_t turn = 0;
    for (const Filter& filter : filter_catalogue()) {
      for (const auto& [name, scene] : scene_catalogue()) {
        const PatternChoice& choice = choices[turn % choices.size()];
        CAPTURE(choice.text());
        CAPTURE(name);
        check_skipping(scene, Pattern(choice, turn / choices.size() % 2 == 0 ? 4 : 1, {7, 3}), filter);
        ++turn;
      }
      ++turn;
    }
  }

  TEST_CASE("skipping changes no bit: sets over the whole image, with pixels that have no sample") {
    for (const PatternChoice& choice : pattern_catalogue()) {
      if (choice.info().area_count == nullptr) continue;
      for (const auto& [name, scene] : scene_catalogue()) {
        CAPTURE(choice.text());
        CAPTURE(name);
        for (const Filter& filter : narrow_and_wide_filters()) {
          for (const int spp : {1, 3}) {
            check_skipping(scene, AreaPoints(choice, scene.grid(), filter.apron(), spp, {7, 3}), filter);
          }
        }
      }
    }
  }

  TEST_CASE("one thread and several give the same bits, and so does a second run") {
    for (const auto& [name, scene] : scene_catalogue()) {
      CAPTURE(name);
      for (const Filter& filter : filter_catalogue()) {
        const ActiveRows rows = enumerate(scene, filter.radius());
        const auto run = [&](int threads) {
          const ThreadLimit limit(threads);
          const Pattern pattern(PatternChoice(parse_spec("dart-throwing:k=50", "test")), 5, {1, 0});
          return render(scene, pattern, filter, Estimator::ratio, rows);
        };
        const Rendered one = run(1);
        CHECK(same(one, run(2)));
        CHECK(same(one, run(4)));
      }
    }
  }
}
