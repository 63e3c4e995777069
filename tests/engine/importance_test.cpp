// Importance estimators: skipping and threads change no bit, over the whole catalogue; sums are those of the samples
// one by one; and the errors have the law they must have.
#include <doctest/doctest.h>

#include <cmath>
#include <string>
#include <vector>

#include "catalogue.h"
#include "core/error.h"
#include "core/parallel.h"
#include "engine/exact.h"
#include "engine/inverse_distribution.h"
#include "engine/render.h"
#include "engine/skipping.h"
#include "moving_scenes.h"

using namespace moire;
using namespace moire::test;

namespace {

constexpr Estimator kForms[] = {Estimator::importance, Estimator::importance_ratio};

Filter filter_of(const char* text) { return Filter(parse_spec(text, "test")); }

Pattern pattern_of(const char* text, int n, Draw draw = {}) {
  const PatternChoice choice(parse_spec(text, "test"));
  return Pattern(choice, choice.info().counts(choice.args(), n).above, draw);
}

bool same(const Rendered& a, const Rendered& b) {
  if (a.pixels != b.pixels || a.value.size() != b.value.size() || a.samples_evaluated != b.samples_evaluated) {
    return false;
  }
  for (std::size_t i = 0; i < a.value.size(); ++i) {
    if (!same_bits(a.value[i], b.value[i])) return false;
  }
  return true;
}

void check_skipping(const TestImage& scene, const Pattern& pattern, const Filter& filter) {
  CAPTURE(filter.text());
  CAPTURE(pattern.n());
  const ActiveRows rows = enumerate(scene, filter.radius());
  const std::int64_t pixels = std::int64_t{scene.grid().width} * scene.grid().height;
  for (const Estimator form : kForms) {
    const Rendered some = render(scene, pattern, filter, form, rows),
                   all = render(scene, pattern, filter, form, rows, true);
    int not_finite = 0, negative_zeros = 0;
    for (const double value : all.value) {
      not_finite += !std::isfinite(value);
      negative_zeros += same_bits(value, -0.0);
    }
    CHECK(differences(some, all, rows) == 0);
    CHECK(not_finite == 0);
    CHECK(negative_zeros == 0);
    CHECK(some.fallbacks + all.fallbacks == 0);
    // No apron, and no test beyond the pixels that are active.
    CHECK(some.samples_total == pattern.n() * pixels);
    CHECK(all.samples_total == some.samples_total);
    CHECK(all.samples_evaluated == all.samples_total);
    CHECK(some.samples_evaluated <= pattern.n() * rows.active_pixels());
  }
}

// The mean of numbers, and how far it may be off.
struct Mean {
  double sum = 0, squares = 0, count = 0;
  void add(double x) {
    sum += x;
    squares += x * x;
    ++count;
  }
  double value() const { return sum / count; }
  double standard_error() const { return std::sqrt((squares / count - value() * value()) / (count - 1)); }
};

// The signed form's mean over 500 trials of 4 random samples, in every active pixel.
void check_unbiased(const TestImage& scene, const Filter& filter) {
  const ActiveRows rows = enumerate(scene, filter.radius());
  const Reference reference = exact(scene, filter, rows);
  std::vector<Mean> mean(reference.value.size());
  for (std::uint32_t trial = 0; trial < 500; ++trial) {
    const Rendered r = render(scene, pattern_of("random", 4, {11, trial}), filter, Estimator::importance, rows);
    std::size_t active = 0, index = 0;
    for_each_rendered(rows, r, [&](int, int, Cover cover, double) {
      if (cover == Cover::partial) mean[active++].add(r.value[index]);
      ++index;
    });
  }
  double worst = 0;
  for (std::size_t i = 0; i < mean.size(); ++i) {
    const double spread = mean[i].standard_error();
    // A pixel that the set hardly touches may have no hit in 2000 samples, and so no spread; one with few hits has no
    // normal law: at least about 20 are wanted, p (1 - p) / 2000 with p = 0.01.
    if (spread > 2e-3) worst = std::max(worst, std::fabs(mean[i].value() - reference.value[i]) / spread);
  }
  CHECK(worst < 5);
}

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("skipping changes no bit of an importance estimator: every scene, filters with and without lobes") {
    for (const char* text : {"tent", "box", "box:width=0.5", "gaussian", "mitchell", "lanczos"}) {
      const Filter filter = filter_of(text);
      for (const auto& named : scene_catalogue({14, 12})) {
        const std::string& name = named.first;
        const TestImage& scene = named.second;
        CAPTURE(name);
        check_skipping(scene, pattern_of("random", 3, {7, 3}), filter);
        check_skipping(scene, pattern_of("hammersley", 4), filter);
      }
    }
  }

  TEST_CASE("every filter and every pattern once, against the exhaustive image") {
    const auto scenes = scene_catalogue({14, 12});
    const auto patterns = pattern_catalogue();
    std::size_t turn = 0;
    for (const Filter& filter : filter_catalogue()) {
      const PatternChoice& choice = patterns[turn % patterns.size()];
      CAPTURE(choice.text());
      check_skipping(scenes[turn % scenes.size()].second,
                     Pattern(choice, choice.info().counts(choice.args(), 4).above, {7, 3}), filter);
      ++turn;
    }
    CHECK(turn >= patterns.size());
  }

  TEST_CASE("a moving scene takes the times of the pattern's points, with skipping and without") {
    const Grid grid{14, 12};
    const TestImage scenes[] = {scenes::moving_edge({7.3, 5.7}, {0.3, 1}, {2, 3.5}, grid),
                                scenes::moving_disk({6, 5}, 3.25, {3.5, 2}, grid),
                                scenes::moving_disks({3, 3, 1.5, 9, 7, 2}, {1.5, -2}, grid)};
    for (const TestImage& scene : scenes) {
      for (const char* pattern : {"random", "zaremba", "scan-time"}) {
        for (const char* text : {"box", "mitchell", "tent"}) {
          check_skipping(scene, pattern_of(pattern, 4, {3, 0}), filter_of(text));
        }
      }
    }
    // Its mean is that over the time: 2000 trials of one pixel that the edge sweeps over.
    const Filter tent = filter_of("tent");
    const ActiveRows rows = enumerate(scenes[0], tent.radius());
    const Reference reference = exact(scenes[0], tent, rows);
    Mean mean;
    std::size_t at = 0;
    while (reference.value[at] < 0.3 || reference.value[at] > 0.7) ++at;
    for (std::uint32_t trial = 0; trial < 2000; ++trial) {
      mean.add(render(scenes[0], pattern_of("random", 1, {5, trial}), tent, Estimator::importance, rows).value[at]);
    }
    CHECK(std::fabs(mean.value() - reference.value[at]) < 4.5 * mean.standard_error());
  }

  TEST_CASE("radial filters: skipping changes no bit, and every pixel is unbiased") {
    const auto scenes = scene_catalogue({14, 12});
    std::size_t turn = 0;
    for (const std::string& text : radial_texts()) {
      check_skipping(scenes[turn % scenes.size()].second, pattern_of("random", 4, {7, 3}), filter_of(text.c_str()));
      ++turn;
    }
    const TestImage scene = scenes::edge({4.3, 4.1}, 97.3, {8, 8});
    for (const char* text : {"cone", "disk:radius=1.25", "radial-lanczos", "jinc"}) {
      CAPTURE(text);
      check_unbiased(scene, filter_of(text));
    }
  }

  TEST_CASE("the number of threads changes no bit") {
    for (const char* text : {"tent", "lanczos", "jinc"}) {
      const Filter filter = filter_of(text);
      const TestImage scene = scenes::disk({20.3, 17.2}, 12.25, {40, 36});
      const ActiveRows rows = enumerate(scene, filter.radius());
      const Pattern pattern = pattern_of("random", 9);
      for (const Estimator form : kForms) {
        const auto with_threads = [&](int threads) {
          const ThreadLimit limit(threads);
          return render(scene, pattern, filter, form, rows);
        };
        const Rendered one = with_threads(1);
        CHECK(same(one, with_threads(2)));
        CHECK(same(one, with_threads(7)));
      }
    }
  }

  TEST_CASE("under the unit box both forms are the ratio estimator, bit for bit, moving or not") {
    const Filter box = filter_of("box");
    auto scenes = scene_catalogue({24, 20});
    scenes.emplace_back("moving disk", scenes::moving_disk({9, 8}, 4.25, {6.5, 3}, {24, 20}));
    for (const auto& named : scenes) {
      const std::string& name = named.first;
      const TestImage& scene = named.second;
      CAPTURE(name);
      const ActiveRows rows = enumerate(scene, box.radius());
      for (const char* text : {"random", "zaremba", "hammersley"}) {
        const Pattern pattern = pattern_of(text, 16);
        const Rendered ratio = render(scene, pattern, box, Estimator::ratio, rows);
        for (const Estimator form : kForms) {
          const Rendered got = render(scene, pattern, box, form, rows);
          REQUIRE(got.value.size() == ratio.value.size());
          int different = 0;
          for (std::size_t i = 0; i < got.value.size(); ++i) different += !same_bits(got.value[i], ratio.value[i]);
          CHECK(different == 0);
        }
      }
    }
  }

  TEST_CASE("without negative lobes the two forms are one") {
    const TestImage scene = scenes::edge({15.3, 14.7}, 97.3, {32, 28});
    for (const char* text : {"tent", "bspline", "gaussian", "blackman-harris", "box:width=1.7"}) {
      const Filter filter = filter_of(text);
      const ActiveRows rows = enumerate(scene, filter.radius());
      const Pattern pattern = pattern_of("jittered", 9);
      CHECK(same(render(scene, pattern, filter, kForms[0], rows), render(scene, pattern, filter, kForms[1], rows)));
    }
  }

  TEST_CASE("a pixel is the sum over its samples, taken one by one") {
    // The scene is asked about each sample alone, from the corner of the pixel that holds it.
    for (const char* text : {"tent", "mitchell", "lanczos"}) {
      CAPTURE(text);
      const Filter filter = filter_of(text);
      const InverseDistribution inverse(filter);
      const TestImage scene = scenes::disk({8.3, 7.2}, 4.25, {16, 14});
      const ActiveRows rows = enumerate(scene, filter.radius());
      const Pattern pattern = pattern_of("random", 1100);  // more than are placed at a time
      const Rendered some = render(scene, pattern, filter, Estimator::importance, rows);
      const Rendered ratio = render(scene, pattern, filter, Estimator::importance_ratio, rows);
      std::size_t index = 0;
      int wrong = 0;
      for_each_rendered(rows, some, [&](int x, int y, Cover, double value) {
        const Pixel pixel{x, y};
        std::vector<double> u(1100), v(1100);
        pattern.fill({&pixel, 1}, {u, v});
        int all = 0, inside = 0;
        for (std::size_t i = 0; i < u.size(); ++i) {
          const auto across = inverse.at(u[i]), down = inverse.at(v[i]);
          const double px = 0.5 + across.x, py = 0.5 + down.x;
          const Pixel cell{x + static_cast<std::int64_t>(std::floor(px)),
                           y + static_cast<std::int64_t>(std::floor(py))};
          const double in_x = px - std::floor(px), in_y = py - std::floor(py);
          std::uint8_t in = 0;
          scene.contains({&cell, 1}, {&in_x, 1}, {&in_y, 1}, {&in, 1});
          all += across.sign * down.sign;
          inside += across.sign * down.sign * in;
        }
        const double area = inverse.absolute_integral() * inverse.absolute_integral();
        wrong += value != area * inside / 1100;
        wrong += ratio.value[index++] != static_cast<double>(inside) / all;
      });
      CHECK(wrong == 0);
    }
  }

  TEST_CASE("with random points the signed form is unbiased in every pixel") {
    const TestImage scene = scenes::edge({4.3, 4.1}, 97.3, {8, 8});
    for (const char* text : {"tent", "mitchell", "lanczos"}) {
      CAPTURE(text);
      check_unbiased(scene, filter_of(text));
    }
  }

  TEST_CASE("signs alone make noise on a flat image: sqrt((A^2 - 1) / N), A the integral of |k| over the plane") {
    // Inside the scene everywhere; A mean(s) has mean 1, a single A s the mean square A^2.
    const TestImage scene = scenes::edge({-100, 0}, 0, {100, 100});
    for (const char* text : {"mitchell", "catmull-rom", "lanczos"}) {
      const Filter filter = filter_of(text);
      const double area = std::pow(InverseDistribution(filter).absolute_integral(), 2);
      const ActiveRows rows = enumerate(scene, filter.radius());
      for (const int n : {1, 16, 64}) {
        CAPTURE(text);
        CAPTURE(n);
        Mean error, square;
        const Rendered r = render(scene, pattern_of("random", n, {3, 0}), filter, Estimator::importance, rows);
        REQUIRE(r.value.size() == 10'000);
        CHECK(r.samples_evaluated == 0);
        for (const double value : r.value) {
          error.add(value - 1);
          square.add((value - 1) * (value - 1));
        }
        CHECK(std::fabs(error.value()) < 4.5 * error.standard_error());
        CHECK(std::fabs(square.value() - (area * area - 1) / n) < 4.5 * square.standard_error() + 1e-12);
        // Where the signs' sum is not 0 the ratio is exact.
        const Rendered ratio =
            render(scene, pattern_of("random", n, {3, 0}), filter, Estimator::importance_ratio, rows);
        for (const double value : ratio.value) CHECK((value == 1 || value == 0));
      }
    }
  }

  TEST_CASE("signs that cancel give no division by zero: the signed form's value, which is 0 on a flat image") {
    const Filter lanczos = filter_of("lanczos");
    const TestImage scene = scenes::edge({-100, 0}, 0, {100, 100});
    const ActiveRows rows = enumerate(scene, lanczos.radius());
    const Pattern pattern = pattern_of("random", 4, {3, 0});
    const Rendered ratio = render(scene, pattern, lanczos, Estimator::importance_ratio, rows);
    const double cancelled = static_cast<double>(std::count(ratio.value.begin(), ratio.value.end(), 0.0));
    // Two of four signs negative: a sign is so with probability p = (1 - 1 / A) / 2, 6 p^2 (1 - p)^2 = 0.187.
    const double p = 0.5 * (1 - 1 / std::pow(InverseDistribution(lanczos).absolute_integral(), 2));
    const double expected = 6 * p * p * (1 - p) * (1 - p);
    CHECK(expected == doctest::Approx(0.187).epsilon(0.003));
    CHECK(std::fabs(cancelled / 1e4 - expected) < 4.5 * std::sqrt(expected * (1 - expected) / 1e4));
  }

  TEST_CASE("estimators have names, forms and one text each, and what is not known is refused") {
    for (const std::string_view text : estimator_texts()) CHECK(name_of(find_estimator(text, "test")) == text);
    CHECK(find_estimator("importance", "test") == Estimator::importance);
    CHECK(find_estimator("importance:form=signed", "test") == Estimator::importance);
    CHECK(find_estimator("importance:form=ratio", "test") == Estimator::importance_ratio);
    for (const char* text : {"importnce", "importance:form=sum", "importance:from=ratio", "ratio:form=signed", ""}) {
      CHECK_THROWS_AS(find_estimator(text, "test"), Error);
    }
    CHECK_NOTHROW(require_layout(Estimator::importance, Layout::pixel, "test"));
    CHECK_NOTHROW(require_layout(Estimator::unnormalised, Layout::image, "test"));
    for (const Estimator form : kForms) CHECK_THROWS_AS(require_layout(form, Layout::image, "test"), Error);
  }
}
