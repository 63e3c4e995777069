// The reports of a benchmark, from synthetic rows.
#include "reports/bench_report.h"

#include <doctest/doctest.h>

#include <cmath>
#include <string>

#include "study/benchmark_rows.h"

using namespace moire;

namespace {

// Two scenes, two filters, three patterns and counts; jittered is best, and dear.
Benchmark synthetic() {
  Benchmark out;
  out.settings.repeats = 3;
  for (const char* scene : {"edge", "disk|x"}) {
    for (const char* pattern : {"regular", "jittered", "random"}) {
      for (const int spp : {4, 16, 64}) {
        for (const char* filter : {"box", "tent"}) {
          const double dear = pattern[0] == 'j' ? 2 : 1, good = pattern[0] == 'j' ? 0.1 : 1;
          Row row;
          row.set("scene", std::string(scene));
          row.set("layout", std::string("pixel"));
          row.set("pattern", std::string(pattern));
          row.set("spp", std::int64_t{spp});
          row.set("filter", std::string(filter));
          row.set("estimator", std::string("ratio"));
          row.set("pixels_active", std::int64_t{100});
          row.set("samples_total", std::int64_t{1000 * spp});
          row.set("samples_evaluated", std::int64_t{100 * spp});
          row.set("rmse_active", good / spp);
          row.set("rmse_active_lo", 0.9 * good / spp);
          row.set("rmse_active_hi", 1.1 * good / spp);
          CaseTimings timings;
          for (const double drift : {1.0, 1.1, 0.9}) {
            timings.setup.push_back(100 * drift);
            timings.first_use.push_back(10 * drift);
            timings.reference.push_back(1000 * drift);
            timings.render.push_back(1e4 * dear * spp * drift);
            if (spp == 4) timings.exhaustive.push_back(1e5 * dear * spp * drift);
          }
          timings.generation = timings.evaluation = timings.reconstruction = timings.render;
          set_case_times(row, timings);
          row.set("exhaustive_same", spp == 4 ? Cell(true) : Cell());
          out.rows.push_back(row);
        }
      }
    }
  }
  mark_fronts(out.rows);
  out.exponents = fit_exponents(out.rows);
  for (const int threads : {1, 2}) {
    Row row;
    row.set("time_threads", std::int64_t{threads});
    const std::vector<double> one = {2e6, 2.2e6, 1.8e6};
    std::vector<double> here;
    for (const double t : one) here.push_back(t / threads);
    set_timings(row, "time_render_ns", here);
    set_ratio(row, "time_speedup", one, here);
    out.scaling.push_back(row);
  }
  return out;
}

std::size_t count_of(const std::string& text, const std::string& word) {
  std::size_t count = 0;
  for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) ++count;
  return count;
}

const Host kHost{"A processor", 2, "an OS"};

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("the plot has a panel per scene and filter, a series per pattern, and the front of the rows") {
    const Benchmark benchmark = synthetic();
    const LogPlot plot = bench_plot("name", benchmark.rows);
    CHECK(plot.columns == 2);
    REQUIRE(plot.panels.size() == 4);
    std::size_t points = 0, front = 0, marked = 0;
    for (const PlotPanel& panel : plot.panels) {
      REQUIRE(panel.series.size() == 3);
      for (const PlotSeries& series : panel.series) {
        CHECK(series.points.size() == 3);
        for (const PlotPoint& point : series.points) {
          ++points;
          front += point.on_front;
          CHECK(point.y_lo < point.y);
          CHECK(point.y_hi > point.y);
        }
      }
    }
    for (const Row& row : benchmark.rows) marked += row.flag("time_front");
    CHECK(points == benchmark.rows.size());
    CHECK(front == marked);
    CHECK(count_of(log_plot_svg(plot), "class=\"point\"") == points);
  }

  TEST_CASE("the terminal has a table per scene and filter, with the front, the exponents and the machine") {
    const std::string text = bench_text(synthetic(), kHost);
    CHECK(text.starts_with("A processor, 2 cores; one thread, 3 repeats\n"));
    for (const char* head : {"edge, box\n", "edge, tent\n", "disk|x, box\n", "disk|x, tent\n"}) {
      CHECK(count_of(text, head) == 1);
    }
    // Regular and random alike at 400 ns per pixel and sample count 4; jittered takes twice as long.
    CHECK(count_of(text, "400 ns 2.5e-01*") == 4 * 2);
    CHECK(count_of(text, "800 ns 2.5e-02*") == 4);
    CHECK(count_of(text, "1.6 us 6.2e-02 ") == 4 * 2);  // 16 of the others: dearer than jittered's 4, and worse
    CHECK(count_of(text, " 1.00 +-0.00") == 4 * 3);
    CHECK(text.find("10 - 10") != std::string::npos);            // exhaustive
    CHECK(text.find("2.00 [2.00, 2.00]") != std::string::npos);  // threads
    CHECK(text.find("nan") == std::string::npos);
  }

  TEST_CASE("the report says all that was measured, and - for what was not") {
    const Benchmark benchmark = synthetic();
    const std::string report =
        bench_markdown("name", benchmark, {"1", "c", "Release", "g++", "-O3", "off"}, kHost, "bench.svg");
    CHECK(report.starts_with("# name: run time against error\n"));
    CHECK(report.find("![RMSE against render time](bench.svg)") != std::string::npos);
    CHECK(report.find("A processor, 2 cores; g++, Release, -O3.") != std::string::npos);
    for (const char* head : {"## The answer", "## How cost grows", "## What skipping saves", "## What threads bring",
                             "## Times by stage", "## How it was measured"}) {
      CHECK(count_of(report, head) == 1);
    }
    CHECK(report.find("medians of 3 repeats") != std::string::npos);
    CHECK(count_of(report, "| yes |") == 2 * 2 * 3);
    CHECK(report.find("nan") == std::string::npos);
    CHECK(report.find("`disk\\|x`") != std::string::npos);
  }

  TEST_CASE("a benchmark of nothing is no error") {
    CHECK(bench_plot("name", {}).panels.empty());
    CHECK_FALSE(bench_text({}, kHost).empty());
    CHECK_FALSE(bench_markdown("name", {}, {}, kHost, "bench.svg").empty());
  }
}
