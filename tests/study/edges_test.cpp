// Errors on random edges against what is known of point sets: with a box filter a pixel's error is the discrepancy of
// its own samples for the half-plane, so that the RMSE over all lines that hit a pixel has closed forms. All numbers
// are for the laws of random_lines.h, which show every pixel the same lines.
#include <doctest/doctest.h>

#include <cmath>
#include <string>

#include "study/run.h"
#include "study/summary.h"

using namespace moire;

namespace {

Summary measure(const std::string& law, const std::string& patterns, const std::string& spp, int lines) {
  const std::string text = "trials = 1\nimages = \"none\"\nspp = " + spp + "\npatterns = " + patterns +
                           "\n[[scene]]\nname = \"" + law + "\"\nkind = \"edge\"\nwidth = 64\nheight = 64\n" +
                           "lines = { law = \"" + law + "\", count = " + std::to_string(lines) + " }\n";
  const Study study = parse_study(text, "s.toml", "s");
  return summarize(run(study, plan(study), {}).rows);
}

const Row& row_of(const Table& table, std::string_view pattern, double spp = 0) {
  for (const Row& row : table) {
    if (row.text("pattern") == pattern && (spp == 0 || row.number("spp") == spp)) return row;
  }
  FAIL("no such row");
  return table.front();
}

// Intervals are +- about 2 standard errors. Expected values are looked for within twice that: the seed is fixed, and
// about 30 comparisons at 4 standard errors fail by chance with a probability near 0.002.
constexpr double kWider = 2;

void check_slope(const Summary& summary, std::string_view pattern, double expected, double most) {
  const Row& row = row_of(summary.slopes, pattern);
  const double half = (row.number("slope_hi") - row.number("slope_lo")) / 2;
  CAPTURE(pattern);
  CAPTURE(row.number("slope"));
  CAPTURE(half);
  CHECK(row.text("ci_method") == "bootstrap-se-t-by-line");
  CHECK(std::fabs(row.number("slope") - expected) <= kWider * half);
  CHECK(half <= most);  // or the comparison says nothing: the rates are a quarter apart
}

void check_rmse(const Summary& summary, std::string_view pattern, double spp, double expected) {
  const Row& row = row_of(summary.rows, pattern, spp);
  const double half = std::log(row.number("rmse_active_hi") / row.number("rmse_active_lo")) / 2;
  CAPTURE(pattern);
  CAPTURE(spp);
  CAPTURE(row.number("rmse_active"));
  CAPTURE(half);
  CHECK(row.text("ci_method") == "t-log-mse-by-line");
  CHECK(std::fabs(std::log(row.number("rmse_active") / expected)) <= kWider * half);
  CHECK(half <= 0.2);
}

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("on isotropic edges random falls as N^-1/2, n-rooks too in the end, jittered as N^-3/4") {
    const Summary summary = measure("isotropic", R"(["random", "jittered", "n-rooks"])", "[64, 256, 1024]", 96);
    check_slope(summary, "random", -0.5, 0.03);
    check_slope(summary, "jittered", -0.75, 0.03);
    // From 64 on; E[T^2] N is 0.0533, 0.0394, 0.0370 and 0.0367 at 4, 16, 64 and 256 (the closed form over 10^5 sets).
    check_slope(summary, "n-rooks", -0.5, 0.03);
    for (const double n : {64, 256, 1024}) {
      // E over lines of the variance of coverage; the mean distance D of two points of a square: RMSE^2 = D / (4 N) and
      // D / (4 N^1.5).
      const double distance = (2 + std::sqrt(2.0) + 5 * std::log(1 + std::sqrt(2.0))) / 15;
      check_rmse(summary, "random", n, std::sqrt(distance / 4 / n));
      check_rmse(summary, "jittered", n, std::sqrt(distance / 4) * std::pow(n, -0.75));
    }
    check_rmse(summary, "n-rooks", 64, std::sqrt(0.0370 / 64));
    check_rmse(summary, "n-rooks", 256, std::sqrt(0.0367 / 256));
  }

  TEST_CASE("on axis-aligned edges n-rooks falls as N^-1, random as N^-1/2, jittered as N^-3/4") {
    const Summary summary = measure("axis-aligned", R"(["random", "jittered", "n-rooks"])", "[64, 256, 1024]", 96);
    check_slope(summary, "random", -0.5, 0.03);
    check_slope(summary, "jittered", -0.75, 0.05);
    check_slope(summary, "n-rooks", -1, 0.05);
    // An edge at a random place leaves each stratum that it cuts a variance f (1 - f), 1/6 in the mean: all N samples,
    // the sqrt(N) strata of a row, or one sample alone.
    for (const double n : {64, 256, 1024}) {
      check_rmse(summary, "random", n, std::sqrt(1 / (6 * n)));
      check_rmse(summary, "jittered", n, std::sqrt(std::sqrt(n) / 6) / n);
      check_rmse(summary, "n-rooks", n, std::sqrt(1.0 / 6) / n);
    }
  }

  TEST_CASE("patterns that do not vary have their discrepancy for edges as their error, and its two rates") {
    const char* const patterns = R"(["hammersley", "zaremba", "regular"])";
    const Summary isotropic = measure("isotropic", patterns, "[16, 64, 256, 1024]", 192);
    // The closed form of the mean-square discrepancy for isotropic lines, in 113-bit arithmetic.
    check_rmse(isotropic, "zaremba", 16, 3.92802931043459e-2);
    check_rmse(isotropic, "zaremba", 256, 4.30632146250483e-3);
    check_rmse(isotropic, "hammersley", 16, 4.83400175772161e-2);
    check_rmse(isotropic, "hammersley", 256, 5.30066515942166e-3);
    const Summary aligned = measure("axis-aligned", patterns, "[16, 64, 256, 1024]", 192);
    for (const char* pattern : {"hammersley", "zaremba"}) {
      check_slope(aligned, pattern, -1, 0.06);
      // Far from the other rate, on either side of -7/8.
      CHECK(row_of(aligned.slopes, pattern).number("slope_hi") < -0.875);
      CHECK(row_of(isotropic.slopes, pattern).number("slope_lo") > -0.875);
    }
    // Columns of sqrt(N) samples: the error is uniform within half a column.
    check_slope(aligned, "regular", -0.5, 0.06);
    for (const double n : {16, 64, 256, 1024}) check_rmse(aligned, "regular", n, 1 / std::sqrt(12 * n));
  }
}
