// The measure `spectrum` in studies: what its columns say of cases whose answer is known, and the ranking.
#include "study/noise_measures.h"

#include <doctest/doctest.h>

#include <cmath>
#include <string>
#include <vector>

#include "study/columns.h"
#include "study/noise_ranking.h"
#include "study/summary.h"

using namespace moire;

namespace {

const char* const kDisk = R"(
images = "none"
[[scene]]
name = "disk"
kind = "disk"
width = 32
height = 32
center = [15.7, 16.4]
radius = 11.25
)";

Study study_of(const std::string& text) { return parse_study(text + kDisk, "s.toml", "s"); }

Table rows_of(const Study& study) { return run(study, plan(study), {}).rows; }

const Row& last_row(const Table& rows, const std::string& pattern) {
  const Row* last = nullptr;
  for (const Row& row : rows) {
    if (row.text("pattern") == pattern) last = &row;
  }
  REQUIRE(last != nullptr);
  return *last;
}

// A row as summaries have it.
Row summary_row(const std::string& scene, const std::string& pattern, double rmse, double csf, double colour,
                double noise, double structured) {
  Row row;
  row.set("scene", scene);
  row.set("pattern", pattern);
  row.set("spp", std::int64_t{4});
  row.set("filter", std::string("box"));
  row.set("estimator", std::string("ratio"));
  row.set("rmse_all", rmse);
  row.set("csf_rms", csf);
  const auto finite = [](double v) { return std::isfinite(v) ? Cell(v) : Cell(); };
  row.set("low_frequency_ratio", finite(colour));
  row.set("low_frequency_noise", finite(noise));
  row.set("structured_fraction", structured);
  row.set("structured_fraction_error", 0.02);
  row.set("peak_significant", structured > 0.5);
  row.set("peak_height_db", 10 * structured);
  return row;
}

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("noise and structure add up to the mean squared error over all pixels and trials") {
    for (const char* window : {"none", "hann"}) {
      const Study study = study_of(
          "trials = 6\nspp = [4]\npatterns = [\"random\", \"zaremba\"]\nfilters = [\"tent\"]\n"
          "measures = [\"error\", \"spectrum\"]\nspectrum = { window = \"" +
          std::string(window) + "\" }\n");
      const Table rows = rows_of(study);
      for (const char* pattern : {"random", "zaremba"}) {
        CAPTURE(pattern);
        double squares = 0, count = 0;
        for (const Row& row : rows) {
          if (row.text("pattern") != pattern) continue;
          squares += row.number("mse_all");
          ++count;
          // Only the last trial's row has the columns.
          CHECK((row.find("csf_rms") != nullptr) == (&row == &last_row(rows, pattern)));
        }
        const Row& last = last_row(rows, pattern);
        CHECK(last.text("spectrum_window") == window);
        const double power = last.number("noise_power") + last.number("structured_power");
        // Parseval, to the transform's rounding; the window sees another part of the image.
        if (std::string(window) == "none") CHECK(power == doctest::Approx(squares / count).epsilon(1e-12));
        CHECK(power > 0);
      }
    }
  }

  TEST_CASE("a pattern that does not vary is all structure, and box noise in pixels of their own is white") {
    const Study study = study_of(
        "trials = 48\nspp = [4]\npatterns = [\"random\", \"jittered\", \"zaremba:instance=shift\", \"zaremba\"]\n"
        "measures = [\"error\", \"spectrum\"]\n");
    const Table rows = rows_of(study);
    const Row& fixed = last_row(rows, "zaremba");
    CHECK(fixed.number("structured_fraction") == 1);
    CHECK(fixed.number("noise_power") == 0);
    CHECK(std::isfinite(fixed.number("peak_p")));
    CHECK_FALSE(std::isfinite(fixed.number("low_frequency_ratio")));
    for (const char* pattern : {"random", "jittered", "zaremba:instance=shift"}) {
      CAPTURE(pattern);
      const Row& row = last_row(rows, pattern);
      // Twice the 95% interval: three comparisons at a fixed seed.
      const double ratio = row.number("low_frequency_ratio");
      CHECK(1 - 2 * (ratio - row.number("low_frequency_ratio_lo")) < ratio);
      CHECK(ratio < 1 + 2 * (row.number("low_frequency_ratio_hi") - ratio));
      // Unbiased patterns: four standard errors.
      CHECK(std::fabs(row.number("structured_fraction")) < 4 * row.number("structured_fraction_error"));
    }
  }

  // One set over the image: a fixed number of samples in each pixel would take the lowest frequencies away.
  TEST_CASE("wide filters turn white noise into low-frequency noise") {
    const Study study = study_of(
        "trials = 16\nspp = [4]\nlayout = \"image\"\npatterns = [\"random\"]\nfilters = [\"box\", \"bspline\"]\n"
        "estimators = [\"unnormalised\"]\nmeasures = [\"error\", \"spectrum\"]\n");
    const Table rows = rows_of(study);
    CHECK(rows[15].number("low_frequency_ratio") < 1.5);
    CHECK(rows[31].number("low_frequency_ratio") > 2);
  }

  TEST_CASE("spectra are handed out once per case, after its last trial, if images are kept") {
    for (const char* images : {"none", "first-trial"}) {
      std::string text = kDisk;
      text.replace(text.find("\"none\""), 6, "\"" + std::string(images) + "\"");
      const Study study = parse_study(
          "trials = 3\nspp = [1, 4]\nlayout = [\"pixel\", \"image\"]\npatterns = [\"random\", \"hammersley\"]\n"
          "measures = [\"error\", \"spectrum\"]\n" +
              text,
          "s.toml", "s");
      int handed = 0;
      Observer observer;
      observer.spectra = [&](const Case& c, const Spectra& spectra) {
        ++handed;
        CHECK(c.trial + 1 == trials_of(study, study.patterns[c.pattern]));
        CHECK(spectra.trials == trials_of(study, study.patterns[c.pattern]));
        CHECK(radial_rows(spectra).size() >= 16);
      };
      run(study, plan(study), observer);
      CHECK(handed == (std::string(images) == "none" ? 0 : 8));
    }
  }

  TEST_CASE("rankings are by ratios to each scene's best, and who has no noise has no rank in it") {
    const double none = std::nan("");
    const Table ranking = rank_noise(
        {summary_row("a", "jittered", 1, 2, 1.0, 4, 0.0), summary_row("a", "dart-throwing", 2, 1, 0.5, 1, 0.01),
         summary_row("a", "zaremba", 0.5, 4, none, none, 1), summary_row("b", "jittered", 1, 2, 1.2, 9, 0.0),
         summary_row("b", "dart-throwing", 2, 1, 0.7, 1, 0.01), summary_row("b", "zaremba", 0.5, 4, none, none, 1),
         summary_row("b", "random", 9, 9, 1, 9, 0)});
    REQUIRE(ranking.size() == 3);  // random has one scene alone
    CHECK(ranking[0].text("pattern") == "zaremba");
    CHECK(ranking[0].number("rank_rmse") == 1);
    CHECK(ranking[0].number("rank_csf") == 3);
    CHECK(ranking[0].number("rank_structured") == 3);
    CHECK(ranking[0].number("peaks") == 2);
    CHECK(ranking[0].number("highest_peak_db") == 10);
    CHECK_FALSE(std::isfinite(ranking[0].number("rank_low_frequency")));
    CHECK(ranking[1].text("pattern") == "jittered");
    CHECK(ranking[1].number("relative_rmse") == doctest::Approx(2));
    CHECK(ranking[1].number("relative_low_frequency") == doctest::Approx(std::sqrt(2.0 * 3.0)));
    CHECK(ranking[1].number("low_frequency_ratio") == doctest::Approx(1.1));
    CHECK(ranking[1].number("rank_colour") == 2);
    CHECK(ranking[2].number("rank_low_frequency") == 1);
    CHECK(ranking[2].number("rank_colour") == 1);
    CHECK(rank_noise({}).empty());
  }

  TEST_CASE("a study that does not name spectrum has none of its columns, in rows, summaries and rankings") {
    const Study study = study_of("trials = 3\nspp = [4]\npatterns = [\"random\"]\n");
    const Table rows = rows_of(study);
    const Summary summary = summarize(rows);
    for (const std::string_view name : kSpectrumColumns) {
      for (const Row& row : rows) CHECK(row.find(name) == nullptr);
      for (const Row& row : summary.rows) CHECK(row.find(name) == nullptr);
    }
    CHECK(summary.noise.empty());
  }
}
