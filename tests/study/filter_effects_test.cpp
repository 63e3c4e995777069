// What a filter itself changes: errors against coverage, the flat field, ringing, the ranking; against brute force and
// closed forms.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "engine/catalogue.h"
#include "study/coverage.h"
#include "study/filter_ranking.h"
#include "study/flat_field.h"
#include "study/run.h"
#include "study/summary.h"

using namespace moire;

namespace {

// Every pixel of the image, 0 and 1 where it has no value of its own.
std::vector<double> dense(const ActiveRows& rows, const Rendered& image) {
  const Grid grid = rows.grid();
  std::vector<double> out;
  for (int y = 0; y < grid.height; ++y) {
    for (const Run& run : rows.row(y))
      out.insert(out.end(), static_cast<std::size_t>(run.x1 - run.x0), run.cover == Cover::all ? 1.0 : 0.0);
  }
  for_each_rendered(rows, image, [&](int x, int y, Cover, double value) {
    out[static_cast<std::size_t>(y) * static_cast<std::size_t>(grid.width) + static_cast<std::size_t>(x)] = value;
  });
  return out;
}

Rendered exact_image(const Truth& truth) {
  Rendered image;
  image.value = truth.exact.value;
  return image;
}

bool is_active(const ActiveRows& rows, int x, int y) {
  for (const Run& run : rows.row(y)) {
    if (x < run.x1) return run.cover == Cover::partial;
  }
  return false;
}

// A term of a mean of n squares errs by 3 u of itself, the compensated sum by 2 u: the orders of addition differ.
constexpr double kRounding = 8 * 0x1p-53;

const char* const kStudy = R"(
patterns = ["random", "jittered"]
spp = [4]
trials = 2
filters = ["box", "mitchell", "bspline:order=5"]
images = "none"
[[scene]]
kind = "disk"
width = 20
height = 20
center = [10.2, 9.9]
radius = 6.5
)";

Study study_with(const std::string& measures) { return parse_study("measures = " + measures + kStudy, "s.toml", "s"); }

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("the box filter itself changes nothing, and every other filter does") {
    const TestImage scene = scenes::disk({15.7, 14.2}, 9.25, {32, 28});
    const Filter unit_box(parse_spec("box", "test"));
    const Truth box = find_truth(scene, unit_box);
    CHECK(coverage_errors(box.rows, exact_image(box), box).all.max_abs == 0);
    for (const std::string& text : filter_variants()) {
      CAPTURE(text);
      const Filter filter(parse_spec(text, "test"));
      if (filter.is_unit_box()) continue;
      const Truth truth = find_truth(scene, filter);
      const double change = coverage_errors(truth.rows, exact_image(truth), box).all.rmse;
      // The disk's border is 58 pixels of 896; a kernel as wide as this image's disk changes no pixel by more than 1,
      // and one that differs from the box by a hundredth changes those on the border by about that.
      CHECK(change > 0.01 * 58 / 896);
      CHECK(change < 1);
    }
  }

  TEST_CASE("the flat field of a regular grid is periodic, and jitter lies between the two") {
    const Filter filter(parse_spec("mitchell", "test"));
    const auto rms = [&](const char* pattern) {
      return flat_field_rms(Pattern(PatternChoice(parse_spec(pattern, "test")), 16, Draw{1, 0}), filter);
    };
    // A partition of unity summed over a grid of quarter pixels: 1 up to rounding.
    CHECK(rms("regular") < 1e-15);
    CHECK(rms("jittered") > 1e-3);
    CHECK(rms("jittered") < rms("random") / 2);
  }

  TEST_CASE("columns of measures are there if the study names the measure, and not else") {
    const std::map<std::string, std::string> column_of = {
        {"coverage", "rmse_coverage_all"}, {"flat-field", "flat_field_rms"}, {"ringing", "overshoot_exact"}};
    const auto first_row = [](const std::string& list) {
      const Study study = study_with(list);
      return run(study, plan(study), {}).rows.front();
    };
    for (const auto& [measure, unused] : column_of) {
      const Row row = first_row("[\"error\", \"" + measure + "\"]");
      for (const auto& [other, column] : column_of) {
        CAPTURE(measure);
        CAPTURE(column);
        CHECK((row.find(column) != nullptr) == (other == measure));
      }
      const Row plain = first_row("[\"error\"]");
      for (const auto& [name, cell] : plain.cells()) {
        if (!name.starts_with("time_")) CHECK(*row.find(name) == cell);
      }
    }
  }

  TEST_CASE("a positive kernel leaves [0, 1] nowhere, and a negative lobe shows in the exact image") {
    const Study study = study_with("[\"error\", \"ringing\"]");
    for (const Row& row : run(study, plan(study), {}).rows) {
      CAPTURE(row.text("filter"));
      const bool rings = row.text("filter") == "mitchell";
      CHECK((row.number("overshoot_exact") > 0.001) == rings);
      CHECK((row.number("undershoot_exact") > 0.001) == rings);
      CHECK((row.number("ringing_rms_exact") > 0.0001) == rings);
      // Reconstructed by ratios of positive weights: a mean of zeros and ones.
      if (!rings) CHECK(row.number("overshoot_got") <= 1e-15);
      CHECK(row.number("ringing_rms_exact") <= std::max(row.number("overshoot_exact"), row.number("undershoot_exact")));
    }
  }

  TEST_CASE("the ranking is that of ratios to the first, paired by scene and trial, of filters that have them all") {
    Table rows;
    const auto add = [&](const char* scene, const char* filter, std::int64_t trial, double sampling, double total) {
      Row row;
      row.set("scene", std::string(scene));
      row.set("pattern", std::string("jittered"));
      row.set("spp", std::int64_t{16});
      row.set("filter", std::string(filter));
      row.set("estimator", std::string("ratio"));
      row.set("trial", trial);
      row.set("rmse_all", sampling);
      row.set("rmse_coverage_all", total);
      rows.push_back(row);
    };
    // Trial 1 is twice as bad for both: the ratio is the same, and its interval has no width.
    for (const std::int64_t trial : {0, 1}) {
      const double scale = trial == 0 ? 1 : 2;
      add("edge", "box", trial, 0.02 * scale, 0.02 * scale);
      add("edge", "tent", trial, 0.01 * scale, 0.04 * scale);
      add("disk", "box", trial, 0.8 * scale, 0.8 * scale);
      add("disk", "tent", trial, 0.1 * scale, 0.9 * scale);
    }
    add("disk", "lanczos", 0, 0.01, 0.01);
    const Table ranking = rank_filters(rows);
    REQUIRE(ranking.size() == 2);
    CHECK(ranking[0].text("filter") == "box");
    CHECK(ranking[0].number("rank_total") == 1);
    CHECK(ranking[0].number("rank_sampling") == 2);
    CHECK(ranking[0].number("relative_total") == 1);
    CHECK(ranking[0].number("relative_sampling") == doctest::Approx(std::sqrt(2.0 * 8.0)));
    CHECK(ranking[0].number("relative_sampling_lo") == doctest::Approx(4));
    CHECK(ranking[0].number("relative_sampling_hi") == doctest::Approx(4));
    CHECK(ranking[1].number("relative_total") == doctest::Approx(std::sqrt(2.0 * 9.0 / 8.0)));
    CHECK(ranking[1].number("relative_sampling") == 1);
    // With a trial in which the tent is better by a factor: log-ratios 0.5 log 2.25 and that less log 4, mean and
    // half-width by Student's t for two trials, 12.706 times half their distance.
    rows.clear();
    for (const std::int64_t trial : {0, 1}) {
      add("edge", "box", trial, 0.02, 0.02);
      add("edge", "tent", trial, 0.04, trial == 0 ? 0.03 : 0.12);
    }
    const Table spread = rank_filters(rows);
    CHECK(spread[1].number("relative_total") == doctest::Approx(3));
    CHECK(spread[1].number("relative_total_hi") ==
          doctest::Approx(3 * std::exp(12.7062 * std::log(2.0))).epsilon(1e-4));
    // A place without any error is left out; nothing left, nothing ranked.
    add("dot", "box", 0, 0, 0);
    add("dot", "tent", 0, 0.1, 0.1);
    CHECK(rank_filters(rows)[1].number("relative_total") == doctest::Approx(3));
    rows.clear();
    add("dot", "box", 0, 0, 0);
    CHECK(rank_filters(rows).empty());
    CHECK(rank_filters({}).empty());
  }

  TEST_CASE("summaries carry the errors against coverage, and give the ranking") {
    const Study study = study_with("[\"error\", \"coverage\", \"flat-field\", \"ringing\"]");
    const Table rows = run(study, plan(study), {}).rows;
    const Summary summary = summarize(rows);
    REQUIRE(summary.rows.size() == 6);
    const Row &first = rows[0], &second = rows[1], &mean = summary.rows[0];
    CHECK(mean.number("rmse_coverage_all") ==
          doctest::Approx(std::sqrt((first.number("mse_coverage_all") + second.number("mse_coverage_all")) / 2)));
    CHECK(mean.number("rmse_coverage_all_lo") <= mean.number("rmse_coverage_all"));
    CHECK(mean.number("rmse_filter_all") == 0);
    CHECK(mean.number("overshoot_got") == std::max(first.number("overshoot_got"), second.number("overshoot_got")));
    CHECK(summary.filters.size() == 6);
    CHECK(summarize(run(study_with("[\"error\"]"), plan(study), {}).rows).filters.empty());
  }
}

TEST_SUITE("heavy") {
  TEST_CASE("errors against coverage are those of whole images, for every filter, scene and kind of rendering") {
    const Filter unit_box(parse_spec("box", "test"));
    const Pattern pattern(PatternChoice(parse_spec("jittered", "test")), 4, Draw{1, 0});
    for (const auto& [name, scene] : test::scene_catalogue({20, 18})) {
      const Truth box = find_truth(scene, unit_box);
      const std::vector<double> coverage = dense(box.rows, exact_image(box));
      for (const char* text : {"box", "box:width=0.25", "box:width=0.9", "tent", "mitchell", "lanczos"}) {
        CAPTURE(name);
        CAPTURE(text);
        const Filter filter(parse_spec(text, "test"));
        const Truth truth = find_truth(scene, filter);
        const Rendered images[] = {exact_image(truth), render(scene, pattern, filter, Estimator::ratio, truth.rows),
                                   render(scene, pattern, filter, Estimator::unnormalised, truth.rows),
                                   render(scene, pattern, filter, Estimator::ratio, truth.rows, true)};
        for (const Rendered& image : images) {
          const std::vector<double> got = dense(truth.rows, image);
          double all = 0, active = 0;
          std::int64_t n_active = 0;
          const int width = scene.grid().width;
          for (std::size_t i = 0; i < got.size(); ++i) {
            const int x = static_cast<int>(i) % width, y = static_cast<int>(i) / width;
            const double square = (got[i] - coverage[i]) * (got[i] - coverage[i]);
            all += square;
            if (!is_active(truth.rows, x, y) && !is_active(box.rows, x, y)) continue;
            active += square;
            ++n_active;
          }
          const CoverageErrors errors = coverage_errors(truth.rows, image, box);
          CHECK(errors.all.n_pixels == static_cast<std::int64_t>(got.size()));
          CHECK(errors.active.n_pixels == n_active);
          // The plain sums here err by a unit per addition.
          const double rounding = kRounding * static_cast<double>(got.size());
          CHECK(errors.all.mse == doctest::Approx(all / static_cast<double>(got.size())).epsilon(rounding));
          if (n_active > 0) {
            CHECK(errors.active.mse == doctest::Approx(active / static_cast<double>(n_active)).epsilon(rounding));
          }
        }
      }
    }
  }

  TEST_CASE("the flat field of independent samples is as noisy as theory says, for every separable filter") {
    for (const std::string& text : filter_variants(Symmetry::separable)) {
      CAPTURE(text);
      const Filter filter(parse_spec(text, "test"));
      const Kernel& k = filter.kernel();
      // E by the midpoint rule, M from K; the rule's error is far below the tolerance.
      double square = 0, mass = 0;
      constexpr int kSteps = 20000;
      const double step = 2 * k.radius() / kSteps;
      for (int i = 0; i < kSteps; ++i) {
        const double at = k.k(-k.radius() + (i + 0.5) * step);
        square += at * at * step;
      }
      for (int i = -filter.apron(); i <= filter.apron(); ++i) {
        const double m = k.K(i + 0.5) - k.K(i - 0.5);
        mass += m * m;
      }
      constexpr int kSpp = 16, kTrials = 4;
      const double theory = (square * square - mass * mass) / kSpp;
      double measured = 0;
      for (std::uint32_t trial = 0; trial < kTrials; ++trial) {
        const Pattern random(PatternChoice(parse_spec("random", "test")), kSpp, Draw{3, trial});
        const double rms = flat_field_rms(random, filter);
        measured += rms * rms / kTrials;
      }
      if (k.is_unit_box()) {
        CHECK(measured == 0);  // counts are exact
        continue;
      }
      // 4 x 1024 pixels of which about (2R)^2 share samples: the variance of a mean square is 2 (2R)^2 / 4096 of its
      // square at most; four standard deviations.
      const double spread = 4 * std::sqrt(2 * std::max(1.0, 4 * k.radius() * k.radius()) / (kTrials * 1024.0));
      CHECK(std::fabs(measured / theory - 1) < spread);
    }
  }
}
