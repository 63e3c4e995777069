// The measure `spectrum` in studies: what its columns say of cases whose answer is known, and the ranking.
#include "study/noise_measures.h"

#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "core/args.h"
#include "message.h"
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
  row.set("rmse_all_lo", 0.9 * rmse);
  row.set("rmse_all_hi", 1.2 * rmse);
  row.set("csf_rms", csf);
  const auto finite = [](double v) { return std::isfinite(v) ? Cell(v) : Cell(); };
  row.set("low_frequency_ratio", finite(colour));
  row.set("low_frequency_ratio_lo", finite(colour - 0.1));
  row.set("low_frequency_ratio_hi", finite(colour + 0.2));
  row.set("low_frequency_noise", finite(noise));
  row.set("low_frequency_noise_lo", finite(0.81 * noise));
  row.set("low_frequency_noise_hi", finite(1.21 * noise));
  row.set("structured_fraction", structured);
  row.set("structured_fraction_error", structured < 1 ? 0.02 : 0.0);
  row.set("structured_fraction_chance", structured < 1 ? 0.015 : 0.0);
  row.set("peak_significant", structured > 0.5);
  row.set("peak_height_db", 10 * structured);
  return row;
}

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("noise and structure add up to the mean squared error over all pixels and trials, through the window") {
    for (const SpectrumWindow window : {SpectrumWindow::none, SpectrumWindow::hann}) {
      Study study = study_of(
          "trials = 6\nspp = [4]\npatterns = [\"random\", \"zaremba\"]\nfilters = [\"tent\"]\n"
          "measures = [\"error\", \"spectrum\"]\nspectrum = { window = \"" +
          std::string(name_of(window)) + "\" }\n");
      study.images = Images::all;
      // The squared errors through the window, over the mean of its square, of each pattern's trials.
      const std::vector<double> w = window_values(window, 32);
      double mean_window = 0;
      for (const double v : w) mean_window += v * v / 32;
      std::map<std::string, double> squares, weighted, count;
      Observer observer;
      observer.case_image = [&](const Case& c, const Truth& truth, const CaseResult& result) {
        double sum = 0;
        for_each_active(truth.rows, [&](int x, int y, std::int64_t i) {
          const double e = result.error[static_cast<std::size_t>(i)] * w[static_cast<std::size_t>(x)] *
                           w[static_cast<std::size_t>(y)];
          sum += e * e;
        });
        const std::string pattern = study.patterns[c.pattern].text();
        weighted[pattern] += sum / (32 * 32) / (mean_window * mean_window);
        squares[pattern] += result.row.number("mse_all");
        ++count[pattern];
      };
      const Table rows = run(study, plan(study), observer).rows;
      for (const std::string pattern : {"random", "zaremba"}) {
        CAPTURE(pattern);
        for (const Row& row : rows) {
          // Only the last trial's row has the columns.
          if (row.text("pattern") == pattern)
            CHECK((row.find("csf_rms") != nullptr) == (&row == &last_row(rows, pattern)));
        }
        const Row& last = last_row(rows, pattern);
        CHECK(last.text("spectrum_window") == name_of(window));
        const double power = last.number("noise_power") + last.number("structured_power");
        // Parseval: the transform's error is below 4e-16 x (32 + 32) of the RMS coefficient (dft.h), that of its square
        // twice as much, and sums of 1024 squares in two orders differ by less.
        CHECK(std::fabs(power / (weighted[pattern] / count[pattern]) - 1) <= 1e-13);
        // Errors are at active pixels alone, so that without window this is the mean squared error over all.
        if (window == SpectrumWindow::none) CHECK(std::fabs(power / (squares[pattern] / count[pattern]) - 1) <= 1e-13);
      }
    }
  }

  TEST_CASE("expected noise is in the radial rows, and not where a window or the image's size is beyond the theory") {
    const std::string head =
        "trials = 2\nspp = [1]\nlayout = \"image\"\npatterns = [\"random\"]\nestimators = [\"unnormalised\"]\n"
        "measures = [\"error\", \"spectrum\"]\n";
    const auto expected_of = [&](const std::string& text) {
      const Study study = parse_study(text, "s.toml", "s");
      Table rings;
      Observer observer;
      observer.spectra = [&](const Case&, const Spectra& spectra) { rings = radial_rows(spectra); };
      const Table rows = run(study, plan(study), observer).rows;
      const bool in_row = std::isfinite(rows.back().number("expected_noise_power"));
      for (const Row& ring : rings) {
        if (ring.number("bins") > 0) CHECK(std::isfinite(ring.number("expected")) == in_row);
      }
      CHECK(!rings.empty());
      return in_row;
    };
    std::string disk = kDisk;
    disk.replace(disk.find("\"none\""), 6, "\"first-trial\"");
    CHECK(expected_of(head + disk));
    CHECK_FALSE(expected_of(head + "spectrum = { window = \"hann\" }\n" + disk));
    std::string large = disk;
    large.replace(large.find("width = 32"), 10, "width = 2049");
    CHECK_FALSE(expected_of(head + large));
  }

  TEST_CASE("a study whose spectra would not fit into memory is refused, with the numbers") {
    const auto study = [](const std::string& layout, int trials) {
      return parse_study("trials = " + std::to_string(trials) + "\nspp = [1]\nlayout = " + layout +
                             "\npatterns = [\"random\"]\nfilters = [\"box\", \"tent\", \"bspline\"]\n"
                             "measures = [\"error\", \"spectrum\"]\n[[scene]]\nkind = \"disk\"\nwidth = 2048\n"
                             "height = 2048\ncenter = [9, 9]\nradius = 3\n",
                         "s.toml", "s");
    };
    // 3 filters x 2^22 pixels x (28 + 4 x 8) bytes.
    CHECK(spectrum_bytes(study("\"pixel\"", 8), 0) == std::int64_t{3} * (1 << 22) * 60);
    CHECK_NOTHROW(plan(study("\"pixel\"", 8)));
    CHECK_NOTHROW(plan(study("[\"pixel\", \"image\"]", 8)));
    // From 32 trials on 156 bytes, which is 3744 MiB.
    const std::string message = message_of([&] { plan(study("[\"pixel\", \"image\"]", 5000)); });
    for (const char* part :
         {"2048 x 2048 pixels", "2 layouts, 3 filters", "156 bytes", "3744 MiB", "2048 are possible"})
      CHECK(contains(message, part));
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
        CHECK(c.trial + 1 == trials_of(study, c.scene, c.pattern));
        CHECK(spectra.trials == trials_of(study, c.scene, c.pattern));
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
    // Intervals: the same means of the ends; rounding.
    const auto is = [&](const char* name, double want) { return std::fabs(ranking[1].number(name) - want) < 1e-14; };
    CHECK(is("relative_rmse_lo", 1.8));
    CHECK(is("relative_rmse_hi", 2.4));
    CHECK(is("relative_low_frequency_lo", 0.9 * std::sqrt(6.0)));
    CHECK(is("relative_low_frequency_hi", 1.1 * std::sqrt(6.0)));
    CHECK(is("low_frequency_ratio_lo", 1.0));
    CHECK(is("low_frequency_ratio_hi", 1.3));
    CHECK(is("structured_fraction_lo", -0.04));
    CHECK(is("structured_fraction_hi", 0.04));
    CHECK_FALSE(std::isfinite(ranking[0].number("structured_fraction_lo")));  // nothing varies
    CHECK(ranking[2].number("structured_fraction") == 0.01);
    CHECK(ranking[2].number("structured_beyond_chance") == 0);  // within two of 0.015
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

TEST_SUITE("heavy") {
  TEST_CASE("expected noise stands beside measured noise where theory knows it, and nowhere else") {
    const Study study = study_of(
        "trials = 48\nspp = [1, 4]\nlayout = [\"pixel\", \"image\"]\nfilters = [\"box\", \"tent\"]\n"
        "patterns = [\"random\", \"jittered\", \"jittered:amount=0.5\", \"n-rooks\"]\n"
        "estimators = [\"ratio\", \"unnormalised\"]\nmeasures = [\"error\", \"spectrum\"]\n");
    std::map<std::string, double> of_random;
    for (const Row& row : rows_of(study)) {
      if (row.find("noise_power") == nullptr) continue;
      const std::string pattern(row.text("pattern"));
      CAPTURE(pattern);
      CAPTURE(row.text("filter"));
      CAPTURE(row.number("spp"));
      const double expected = row.number("expected_noise_power");
      const bool known = row.text("layout") == "image" && row.text("estimator") == "unnormalised" &&
                         (pattern == "random" || pattern == "jittered");
      CHECK(std::isfinite(expected) == known);
      if (!known) continue;
      const double noise = row.number("noise_power");
      // Twice the 95% interval, for 8 comparisons at a fixed seed; cells of 1/8 pixel add 0.5% at most.
      CHECK(expected > noise - 2 * (noise - row.number("noise_power_lo")) - 0.005 * noise);
      CHECK(expected < noise + 2 * (row.number("noise_power_hi") - noise) + 0.005 * noise);
      if (pattern == "random") of_random[std::string(row.text("filter")) + shortest(row.number("spp"))] = expected;
    }
    // Independent points: the density alone counts. Rounding.
    for (const std::string filter : {"box", "tent"})
      CHECK(std::fabs(of_random[filter + "1"] / of_random[filter + "4"] - 4) < 1e-12);
    // Under a box a pixel of coverage v has the variance (v - v^2 / n) / density, n the number of points, all of it
    // here in v: the disk's area over that of the image; v^2 is v but for the border's 70 pixels, which keep a sixth
    // of it. The disk is taken from 32 x 32 points in a pixel: within 2e-4 of its area.
    const double area = 3.14159265358979324 * 11.25 * 11.25;
    const double want = (area - (area - 70.0 / 6) / (32 * 32)) / (32 * 32);
    CHECK(std::fabs(of_random["box1"] / want - 1) < 5e-4);
  }
}
