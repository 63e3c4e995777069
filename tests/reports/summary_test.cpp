// Summaries over trials and convergence rates from raw rows.
#include "study/summary.h"

#include <doctest/doctest.h>

#include <cmath>
#include <string>

#include "measure/statistics.h"
#include "study/columns.h"

namespace moire {
namespace {

Row raw(const std::string& pattern, std::int64_t spp, std::int64_t trial, double mse) {
  Row row;
  row.set("scene", std::string("edge"));
  row.set("pattern", pattern);
  row.set("spp", spp);
  row.set("filter", std::string("box"));
  row.set("estimator", std::string("ratio"));
  row.set("trial", trial);
  row.set("samples_total", std::int64_t{1000} * spp);
  row.set("samples_evaluated", std::int64_t{10} * spp);
  row.set("fallbacks", std::int64_t{0});
  row.set("mse_active", mse);
  row.set("rmse_active", std::sqrt(mse));
  row.set("bias_active", 0.001 * static_cast<double>(trial));
  row.set("max_abs_active", 2 * std::sqrt(mse));
  row.set("mse_all", mse / 100);
  row.set("rmse_all", std::sqrt(mse / 100));
  row.set("error_bound", 1e-15);
  row.set("reference_limited", false);
  row.set("status", std::string("ok"));
  return row;
}

const Row* find(const Table& table, const std::string& pattern, std::int64_t spp = 0) {
  for (const Row& row : table) {
    if (row.text("pattern") == pattern && (spp == 0 || row.number("spp") == static_cast<double>(spp))) return &row;
  }
  return nullptr;
}

bool is_empty(const Row& row, std::string_view name) {
  const Cell* cell = row.find(name);
  return cell != nullptr && std::holds_alternative<std::monostate>(*cell);
}

TEST_SUITE("unit") {
  TEST_CASE("a case's trials are averaged as squares, with interval, extremes and sums") {
    Table rows;
    for (const std::int64_t trial : {0, 1, 2}) {
      rows.push_back(raw("random", 16, trial, 0.01 * static_cast<double>(trial + 1)));
    }
    rows.back().set("bias_sq_active", 0.005);
    rows.back().set("variance_active", 0.015);
    const Summary summary = summarize(rows);
    REQUIRE(summary.rows.size() == 1);
    const Row& row = summary.rows[0];
    CHECK(row.number("n_trials") == 3);
    CHECK(row.number("rmse_active") == doctest::Approx(std::sqrt(0.02)).epsilon(1e-15));
    CHECK(row.number("rmse_all") == doctest::Approx(std::sqrt(0.0002)).epsilon(1e-15));
    const auto interval = rms_interval(std::vector<double>{0.01, 0.02, 0.03});
    CHECK(row.number("rmse_active_lo") == interval->lo);
    CHECK(row.number("rmse_active_hi") == interval->hi);
    CHECK(row.text("ci_method") == kRmsMethod);
    CHECK(row.number("max_abs_active") == 2 * std::sqrt(0.03));
    CHECK(row.number("bias_active") == doctest::Approx(0.001).epsilon(1e-15));
    CHECK(row.number("bias_sq_active") == 0.005);
    CHECK(row.number("variance_active") == 0.015);
    CHECK(*row.find("samples_total") == Cell(std::int64_t{48000}));
    CHECK(*row.find("samples_evaluated") == Cell(std::int64_t{480}));
    CHECK(row.number("error_bound") == 1e-15);
    CHECK_FALSE(row.flag("reference_limited"));
    // One sample count has no rate.
    CHECK(summary.slopes.empty());
    CHECK(is_empty(row, "slope"));
  }

  TEST_CASE("a power law's exponent is found per series, and every summary row carries it") {
    Table rows;
    for (const auto& [pattern, slope] : {std::pair("random", -0.5), std::pair("jittered", -0.75)}) {
      for (const std::int64_t spp : {1, 4, 16, 64}) {
        for (const std::int64_t trial : {0, 1, 2, 3}) {
          const double wobble = 1 + 0.01 * static_cast<double>(trial);
          rows.push_back(raw(pattern, spp, trial, 0.2 * wobble * std::pow(static_cast<double>(spp), 2 * slope)));
        }
      }
    }
    const Summary summary = summarize(rows);
    REQUIRE(summary.slopes.size() == 2);
    CHECK(summary.rows.size() == 8);
    for (const auto& [pattern, slope] : {std::pair("random", -0.5), std::pair("jittered", -0.75)}) {
      const Row* row = find(summary.slopes, pattern);
      REQUIRE(row != nullptr);
      CHECK(row->number("slope") == doctest::Approx(slope).epsilon(1e-13));
      CHECK(row->number("slope_lo") <= row->number("slope_hi"));
      CHECK(row->text("ci_method") == kSlopeMethod);
      CHECK(row->number("spp_min") == 1);
      CHECK(row->number("spp_max") == 64);
      CHECK(row->number("n_spp") == 4);
      CHECK(is_empty(*row, "left_out"));
      const Row* case_row = find(summary.rows, pattern, 4);
      CHECK(case_row->number("slope") == row->number("slope"));
      CHECK(case_row->text("slope_ci_method") == kSlopeMethod);
      CHECK(case_row->text("ci_method") == kRmsMethod);
    }
  }

  TEST_CASE("reference-limited, exact and incomplete cases are no points of a slope, and the row says so") {
    Table rows;
    for (const std::int64_t spp : {1, 4, 16, 64, 256}) {
      for (const std::int64_t trial : {0, 1}) {
        Row row = raw("zaremba", spp, trial, spp == 16 ? 0.0 : 1.0 / static_cast<double>(spp * spp));
        if (spp == 64) row.set("reference_limited", true);
        if (spp != 256 || trial == 0) rows.push_back(row);
      }
    }
    const Summary summary = summarize(rows);
    REQUIRE(summary.slopes.size() == 1);
    const Row& row = summary.slopes[0];
    CHECK(row.text("left_out") == "16 (no error), 64 (reference limited), 256 (other trials)");
    CHECK(row.number("n_spp") == 2);
    CHECK(row.number("spp_max") == 4);
    CHECK(row.number("slope") == doctest::Approx(-1.0).epsilon(1e-14));
    CHECK(find(summary.rows, "zaremba", 64)->flag("reference_limited"));
    CHECK(find(summary.rows, "zaremba", 16)->number("rmse_active") == 0);
  }

  TEST_CASE("one trial has a value and a slope but no interval") {
    const Summary summary = summarize({raw("regular", 1, 0, 0.04), raw("regular", 4, 0, 0.01)});
    REQUIRE(summary.slopes.size() == 1);
    CHECK(summary.slopes[0].number("slope") == doctest::Approx(-0.5).epsilon(1e-14));
    CHECK(is_empty(summary.slopes[0], "slope_lo"));
    CHECK(is_empty(summary.slopes[0], "ci_method"));
    CHECK(summary.rows[0].number("rmse_active") == 0.2);
    CHECK(is_empty(summary.rows[0], "rmse_active_lo"));
    CHECK(is_empty(summary.rows[0], "ci_method"));
    CHECK(is_empty(summary.rows[0], "bias_sq_active"));
  }

  TEST_CASE(
      "random lines are one scene: errors by pixels, intervals and slopes over lines, trials of a line together") {
    // Lines of 10, 20 and 70 pixels; the error of trial t of line k is a power law times its own factor.
    const double pixels[] = {10, 20, 70}, factor[] = {1, 3, 0.5};
    Table rows;
    for (const std::int64_t spp : {1, 4, 16}) {
      for (const std::int64_t line : {2, 0, 1}) {
        for (const std::int64_t trial : {1, 0}) {
          const double mse = factor[line] * (trial == 0 ? 0.9 : 1.1) * std::pow(static_cast<double>(spp), -1.5);
          Row row = raw("jittered", spp, trial, mse);
          row.set("scene", "edges:line=" + std::to_string(line));
          row.set("n_pixels_active", static_cast<std::int64_t>(pixels[line]));
          row.set("pixels_active", static_cast<std::int64_t>(pixels[line]));
          row.set("bias_active", 0.1 * factor[line]);
          if (trial == 1) row.set("variance_active", factor[line]);
          // One line may be small by chance: the family is not limited.
          row.set("reference_limited", line == 2 && spp == 16);
          rows.push_back(row);
        }
      }
    }
    const Summary summary = summarize(rows);
    REQUIRE(summary.rows.size() == 3);
    const Row& row = summary.rows[0];
    const double pooled = (10 * 1 + 20 * 3 + 70 * 0.5) / 100;
    CHECK(row.text("scene") == "edges");
    CHECK(row.number("n_scenes") == 3);
    CHECK(row.number("n_trials") == 2);
    CHECK(row.number("rmse_active") == doctest::Approx(std::sqrt(pooled)).epsilon(1e-15));
    const auto interval = rms_interval(std::vector<double>{1, 3, 0.5}, std::vector<double>{20, 40, 140});
    CHECK(row.number("rmse_active_lo") == doctest::Approx(interval->lo).epsilon(1e-14));
    CHECK(row.number("rmse_active_hi") == doctest::Approx(interval->hi).epsilon(1e-14));
    CHECK(row.text("ci_method") == "t-log-mse-by-line");
    CHECK(row.number("bias_active") == doctest::Approx(0.1 * pooled).epsilon(1e-14));
    CHECK(row.number("variance_active") == doctest::Approx(pooled).epsilon(1e-14));
    CHECK(is_empty(row, "bias_sq_active"));
    CHECK(*row.find("pixels_active") == Cell(std::int64_t{100}));
    CHECK(*row.find("samples_total") == Cell(std::int64_t{6000}));
    CHECK_FALSE(row.flag("reference_limited"));
    REQUIRE(summary.slopes.size() == 1);
    const Row& slope = summary.slopes[0];
    CHECK(slope.text("scene") == "edges");
    CHECK(slope.number("slope") == doctest::Approx(-0.75).epsilon(1e-14));
    CHECK(slope.number("n_spp") == 3);
    CHECK(slope.text("ci_method") == "bootstrap-se-t-by-line");
    // All lines follow one law, whichever are drawn.
    CHECK(slope.number("slope_hi") - slope.number("slope_lo") == doctest::Approx(0).epsilon(1e-12));

    // A line with a law of its own shows in the interval over lines; more trials of it do not narrow that.
    for (Row& r : rows) {
      if (r.text("scene") != "edges:line=1") continue;
      r.set("mse_active", r.number("mse_active") * r.number("spp"));
    }
    const Summary mixed = summarize(rows);
    CHECK(mixed.slopes[0].number("slope_hi") - mixed.slopes[0].number("slope_lo") > 0.1);
    // A line that is missing at one count makes that count no point of the slope.
    rows.pop_back();
    CHECK(summarize(rows).slopes[0].text("left_out") == "16 (other lines or trials)");
  }

  TEST_CASE("failed rows and rows without an error count nowhere, and the order of rows does not matter") {
    Table rows;
    for (const std::int64_t spp : {1, 4, 16}) {
      for (const std::int64_t trial : {0, 1, 2, 3}) {
        rows.push_back(raw("random", spp, trial, 0.1 / static_cast<double>(spp) + 0.001 * static_cast<double>(trial)));
      }
    }
    const Summary straight = summarize(rows);
    Row failed = raw("random", 1, 4, 100);
    failed.set("status", std::string("failed: out of memory"));
    Row empty = raw("random", 1, 5, 100);
    empty.set("rmse_active", {});
    Table mixed(rows.rbegin(), rows.rend());
    mixed.insert(mixed.begin(), failed);
    mixed.push_back(empty);
    const Summary other = summarize(mixed);
    REQUIRE(other.slopes.size() == 1);
    for (const std::string_view name : {"slope", "slope_lo", "slope_hi", "n_trials", "n_spp"}) {
      CHECK(other.slopes[0].number(name) == straight.slopes[0].number(name));
    }
    for (const std::int64_t spp : {1, 4, 16}) {
      for (const std::string_view name : {"rmse_active", "rmse_active_lo", "max_abs_active", "n_trials"}) {
        CHECK(find(other.rows, "random", spp)->number(name) == find(straight.rows, "random", spp)->number(name));
      }
    }
    CHECK(summarize({}).rows.empty());
    CHECK(summarize({failed}).rows.empty());
  }

  TEST_CASE("the columns of an error are named by region, and what does not exist is empty") {
    Row row;
    ErrorTally tally;
    tally.add(3, 2, 0.75, 0.5);
    tally.add_exact(3);
    set_errors(row, "active", tally.finish());
    set_errors(row, "all", ErrorTally().finish());
    CHECK(row.number("n_pixels_active") == 4);
    CHECK(row.number("rmse_active") == 0.125);
    CHECK(row.number("max_x_active") == 3);
    CHECK(row.number("max_got_active") == 0.75);
    CHECK(row.number("p995_active") == 0.25);
    CHECK(*row.find("n_pixels_all") == Cell(std::int64_t{0}));
    CHECK(is_empty(row, "rmse_all"));
    CHECK(is_empty(row, "max_x_all"));
    CHECK(reference_limited(0.9e-14, 1e-15));
    CHECK_FALSE(reference_limited(1.1e-14, 1e-15));
    CHECK_FALSE(reference_limited(0, 0));
  }

  TEST_CASE("a cell that is set again keeps its place") {
    Row row;
    row.set("a", 1.0);
    row.set("b", std::string("x"));
    row.set("a", std::int64_t{2});
    REQUIRE(row.cells().size() == 2);
    CHECK(row.cells()[0].first == "a");
    CHECK(row.number("a") == 2);
    CHECK(std::isnan(row.number("b")));
    CHECK(row.text("a").empty());
    CHECK(row.find("c") == nullptr);
  }
}

}  // namespace
}  // namespace moire
