// Benchmarks: what is measured, never how long it took.
#include "study/benchmark.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <vector>

#include "study/benchmark_rows.h"
#include "study/run.h"
#include "study/stage_times.h"
#include "study/summary.h"
#include "study/truth.h"

using namespace moire;

namespace {

constexpr const char* kStudy = R"(
trials = 3
spp = [1, 4, 16]
patterns = ["regular", "jittered", "random"]
filters = ["box", "tent"]
estimators = ["ratio", "unnormalised"]
measures = ["error", "spectrum"]
images = "all"
[[scene]]
name = "edge"
kind = "edge"
width = 20
height = 16
through = [10.3, 8.1]
normal = 7.0
[[scene]]
name = "disk"
kind = "disk"
width = 20
height = 16
center = [9.7, 8.3]
radius = 5.25
)";

Study small_study() { return parse_study(kStudy, "small.toml", "small"); }

// Enough repeats for a spread, and no time lost.
BenchmarkSettings quick_settings() {
  BenchmarkSettings settings;
  settings.repeats = 3;
  settings.threads = 2;
  settings.least_ns = 1;
  settings.exhaustive_samples = 22 * 18 * 4;  // the images of 4 samples, with the apron of either filter
  return settings;
}

// Names, and texts of cells, of all columns but time_*; doubles as their bits.
std::vector<std::pair<std::string, Cell>> untimed(const Row& row) {
  std::vector<std::pair<std::string, Cell>> cells;
  for (const auto& cell : row.cells()) {
    if (!cell.first.starts_with("time_")) cells.push_back(cell);
  }
  return cells;
}

// A row of a synthetic benchmark.
Row row_of(const std::string& scene, const std::string& pattern, int spp, double time, double rmse) {
  Row row;
  row.set("scene", scene);
  row.set("layout", std::string("pixel"));
  row.set("pattern", pattern);
  row.set("spp", std::int64_t{spp});
  row.set("filter", std::string("box"));
  row.set("estimator", std::string("ratio"));
  row.set("time_render_pixel_ns", time);
  row.set("rmse_active", rmse);
  return row;
}

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("a benchmark has a row per case without its trials, in plan order, with the errors of a run") {
    const Study study = small_study();
    std::vector<std::size_t> done;
    BenchmarkObserver observer;
    observer.progress = [&](std::size_t visits, std::size_t due, double share) {
      CHECK(visits <= due);
      CHECK(share > 0);
      CHECK(share <= 1 + 1e-12);  // a sum of work in another order
      done.push_back(visits);
    };
    const Benchmark benchmark = run_benchmark(study, quick_settings(), observer);
    CHECK(benchmark.complete);
    const std::vector<Case> cases = plan(study);
    // Each trial once for its error; then every case in each round, the one to warm up included.
    REQUIRE(done.size() == cases.size() + 72 * 4);
    for (std::size_t i = 0; i < done.size(); ++i) CHECK(done[i] == i + 1);

    const Summary summary = summarize(run(study, cases, {}).rows);
    REQUIRE(benchmark.rows.size() == 2 * 3 * 3 * 2 * 2);
    REQUIRE(summary.rows.size() == benchmark.rows.size());
    for (std::size_t i = 0; i < summary.rows.size(); ++i) {
      CAPTURE(i);
      const Row &row = benchmark.rows[i], &expected = summary.rows[i];
      for (const char* name : {"scene", "pattern", "spp", "filter", "estimator", "layout", "n_trials", "rmse_active",
                               "rmse_active_lo", "rmse_active_hi", "pixels_active"}) {
        CAPTURE(name);
        CHECK(*row.find(name) == *expected.find(name));
      }
    }
  }

  TEST_CASE("every time is there, positive and ordered: least, median, most") {
    const Study study = small_study();
    const BenchmarkSettings settings = quick_settings();
    const Benchmark benchmark = run_benchmark(study, settings, {});
    std::size_t exhaustive = 0;
    for (const Row& row : benchmark.rows) {
      const bool few = row.number("samples_total") <= static_cast<double>(settings.exhaustive_samples);
      exhaustive += few;
      CHECK(std::holds_alternative<bool>(*row.find("exhaustive_same")) == few);
      if (few) CHECK(row.flag("exhaustive_same"));
      const bool stages = row.text("estimator") == "ratio";
      const std::vector<std::pair<std::string, bool>> expected = {
          {"time_setup", true},
          {"time_first_use", true},
          {"time_reference", true},
          {"time_generation_pixel", stages},
          {"time_evaluation_pixel", stages},
          {"time_reconstruction_pixel", stages},
          {"time_render_pixel", true},
          {"time_exhaustive_pixel", few},
          {"time_exhaustive_sample", few},
      };
      for (const auto& column : expected) {
        const std::string& stem = column.first;
        const bool there = column.second;
        CAPTURE(stem);
        CHECK(std::isfinite(row.number(stem + "_ns")) == there);
        if (!there) continue;
        CHECK(row.number(stem + "_least_ns") >= 0);
        CHECK(row.number(stem + "_ns") >= row.number(stem + "_least_ns"));
        CHECK(row.number(stem + "_ns") <= row.number(stem + "_most_ns"));
        CHECK(row.number(stem + "_deviation_ns") >= 0);
        // Images take their time. The rest may be quicker than the clock ticks, no dearer at first use than again, or
        // no longer than a look at the clock.
        const bool image =
            stem == "time_reference" || stem == "time_render_pixel" || stem.starts_with("time_exhaustive");
        CHECK((!image || row.number(stem + "_ns") > 0));
      }
      CHECK(std::isfinite(row.number("time_exhaustive_ratio")) == few);
      const double rmse = row.number("rmse_active"), seconds = row.number("time_render_pixel_ns") * 1e-9;
      if (rmse > 0) CHECK(row.number("time_efficiency") == doctest::Approx(1 / (rmse * rmse * seconds)));
      CHECK(row.number("time_repeats") == 3);
    }
    CHECK(exhaustive == 2 * 3 * 2 * 2 * 2);  // two of the three counts
    REQUIRE(benchmark.exponents.size() == 2 * 3 * 2 * 2);
    for (const Row& row : benchmark.exponents) {
      CHECK(std::isfinite(row.number("time_exponent")));
      CHECK(row.number("time_exponent_lo") <= row.number("time_exponent"));
      CHECK(row.number("time_exponent_hi") >= row.number("time_exponent"));
      CHECK(row.number("n_spp") == 3);
    }
    REQUIRE(benchmark.scaling.size() == 2);
    CHECK(benchmark.scaling[0].number("time_threads") == 1);
    CHECK(benchmark.scaling[0].number("time_speedup") == 1);
    CHECK(benchmark.scaling[1].number("time_threads") == 2);
    CHECK(benchmark.scaling[1].number("time_speedup") > 0);
  }

  TEST_CASE("two benchmarks of a study differ in time columns alone") {
    const Study study = small_study();
    BenchmarkSettings other = quick_settings();
    other.repeats = 1;
    other.threads = 1;
    const Benchmark a = run_benchmark(study, quick_settings(), {}), b = run_benchmark(study, other, {});
    REQUIRE(a.rows.size() == b.rows.size());
    for (std::size_t i = 0; i < a.rows.size(); ++i) CHECK(untimed(a.rows[i]) == untimed(b.rows[i]));
    REQUIRE(a.exponents.size() == b.exponents.size());
    for (std::size_t i = 0; i < a.exponents.size(); ++i) CHECK(untimed(a.exponents[i]) == untimed(b.exponents[i]));
  }

  TEST_CASE("a benchmark that is stopped has no tables") {
    for (const int after : {0, 5, 200}) {
      int asked = 0;
      BenchmarkObserver observer;
      observer.stop = [&] { return asked++ >= after; };
      const Benchmark benchmark = run_benchmark(small_study(), quick_settings(), observer);
      CHECK_FALSE(benchmark.complete);
      CHECK(benchmark.rows.empty());
      CHECK(benchmark.exponents.empty());
      CHECK(benchmark.scaling.empty());
    }
  }

  TEST_CASE("the fronts of synthetic rows are marked scene by scene") {
    Table rows = {row_of("a", "p", 1, 10, 0.5),  row_of("a", "p", 4, 40, 0.25), row_of("a", "q", 1, 20, 0.5),
                  row_of("a", "q", 4, 30, 0.25), row_of("b", "p", 1, 99, 0.9),  row_of("a", "r", 1, std::nan(""), 0)};
    mark_fronts(rows);
    std::vector<bool> front;
    for (const Row& row : rows) front.push_back(row.flag("time_front"));
    CHECK(front == std::vector<bool>{true, false, false, true, true, false});
  }

  TEST_CASE("exponents of synthetic power laws come back from the largest counts alone") {
    Table rows;
    for (const int spp : {1, 4, 16, 64, 256, 1024}) {
      // A fixed cost that shows only where it is cut off.
      const double fixed = spp < 16 ? 1e4 : 0;
      rows.push_back(row_of("a", "linear", spp, 3.0 * spp + fixed, 0.1));
      rows.push_back(row_of("a", "root", spp, 50.0 * std::sqrt(spp) + fixed, 0.1));
    }
    rows.push_back(row_of("a", "one", 4, 3, 0.1));
    const Table exponents = fit_exponents(rows);
    REQUIRE(exponents.size() == 2);
    CHECK(exponents[0].text("pattern") == "linear");
    CHECK(exponents[0].number("time_exponent") == doctest::Approx(1).epsilon(1e-12));
    CHECK(exponents[1].number("time_exponent") == doctest::Approx(0.5).epsilon(1e-12));
    CHECK(exponents[1].number("spp_min") == 16);
    CHECK(exponents[1].number("spp_max") == 1024);
    CHECK(exponents[1].number("n_spp") == 4);
    for (const Row& row : rows) {
      const double expected = row.text("pattern") == "linear" ? 1.0 : 0.5;
      if (row.text("pattern") == "one") {
        CHECK(std::isnan(row.number("time_exponent")));
      } else {
        CHECK(row.number("time_exponent") == doctest::Approx(expected).epsilon(1e-12));
      }
    }
  }

  TEST_CASE("the cells of the stages are those that windows of active pixels touch, with the pixels that need them") {
    const Study study = small_study();
    for (const NamedScene& scene : study.scenes) {
      for (const Filter& filter : study.filters) {
        const ActiveRows rows = enumerate(scene.image, filter.radius());
        const int reach = filter.apron(), side = 2 * reach + 1;
        std::set<std::pair<int, int>> active;
        for_each_active(rows, [&](int x, int y, std::int64_t) { active.emplace(x, y); });
        const ActiveCells cells(rows, reach);
        std::size_t next = 0, flags = 0;
        for (const ActiveCells::Stretch& s : cells.stretches()) {
          CHECK(s.first == next);
          for (int x = s.x0; x < s.x1; ++x) {
            const auto needed = cells.needed(next++);
            REQUIRE(needed.size() == static_cast<std::size_t>(side * side));
            CHECK(std::count(needed.begin(), needed.end(), 1) > 0);
            for (int i = 0; i < side * side; ++i) {
              const bool is = active.count({x + i % side - reach, s.y + i / side - reach}) == 1;
              CHECK((needed[static_cast<std::size_t>(i)] == 1) == is);
              flags += is;
            }
          }
        }
        CHECK(next == cells.size());
        // Every active pixel is seen from every cell around it.
        CHECK(flags == active.size() * static_cast<std::size_t>(side * side));
        const Pattern pattern(study.patterns[1], 4, Draw{1, 0});
        const StageTimes times = time_stages(scene.image, pattern, filter, cells);
        CHECK(times.samples == static_cast<std::int64_t>(4 * cells.size()));
        CHECK(time_generation(pattern, cells, false) > 0);
      }
    }
  }

  TEST_CASE("threads are tried in powers of two, and as many as there may be") {
    CHECK(thread_steps(1) == std::vector<int>{1});
    CHECK(thread_steps(2) == std::vector<int>{1, 2});
    CHECK(thread_steps(6) == std::vector<int>{1, 2, 4, 6});
    CHECK(thread_steps(8) == std::vector<int>{1, 2, 4, 8});
  }
}
