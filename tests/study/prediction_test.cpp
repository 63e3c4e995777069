// Discrepancies beside images: the ratio of squared error to squared edge discrepancy, correlations, and scenes that go
// with a part of a study's lists.
#include <doctest/doctest.h>

#include <cmath>
#include <string>

#include "measure/discrepancy/edge_l2.h"
#include "measure/discrepancy/expected.h"
#include "measure/discrepancy/star_l2.h"
#include "measure/statistics.h"
#include "message.h"
#include "study/discrepancy_correlation.h"
#include "study/run.h"
#include "study/study.h"
#include "study/summary.h"

using namespace moire;

namespace {

const std::string kLines =
    "[[scene]]\nname = \"lines\"\nkind = \"edge\"\nwidth = 24\nheight = 24\nlines = { law = \"isotropic\", count = 80 "
    "}\n";
const std::string kStill =
    "[[scene]]\nname = \"still\"\nkind = \"edge\"\nwidth = 24\nheight = 24\nthrough = [12.1, 11.7]\nnormal = 33\n";

Study parse(const std::string& text) { return parse_study(text, "s.toml", "s"); }

Table rows_of(const std::string& text) {
  const Study study = parse(text);
  return run(study, plan(study), {}).rows;
}

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("at isotropic edges squared box errors are the squared edge discrepancies of the pixels' samples") {
    const Summary summary = summarize(rows_of(
        "trials = 2\nspp = [4, 16]\nlayout = [\"pixel\", \"image\"]\nimages = \"none\"\npatterns = [\"random\", "
        "\"jittered\", \"zaremba\", \"dart-throwing:k=100\"]\nmeasures = [\"error\", \"edge-ratio\"]\n" +
        kLines));
    CHECK(summary.rows.size() == 16);
    for (const Row& row : summary.rows) {
      CAPTURE(row.text("pattern"));
      CAPTURE(row.number("spp"));
      const double half = (row.number("edge_ratio_hi") - row.number("edge_ratio_lo")) / 2;
      CHECK(half < 0.2);
      // 16 intervals of 95%: twice the half width, some 4 standard errors, is missed by one row of 10,000.
      CHECK(std::fabs(row.number("edge_ratio") - 1) < 2 * half);
    }
  }

  TEST_CASE("at axis-aligned edges the ratio of points that are even along the axes is far below 1") {
    std::string lines = kLines;
    lines.replace(lines.find("isotropic"), 9, "axis-aligned");
    const Summary summary =
        summarize(rows_of("trials = 1\nspp = [64]\nimages = \"none\"\npatterns = [\"n-rooks\"]\nmeasures = "
                          "[\"error\", \"edge-ratio\"]\n" +
                          lines));
    CHECK(summary.rows[0].number("edge_ratio_hi") < 0.2);
  }

  TEST_CASE("the ratio's cells are empty where a pixel is not the mean of its own samples") {
    const Table rows = rows_of(
        "trials = 1\nspp = [4]\nimages = \"none\"\npatterns = [\"jittered\"]\nfilters = [\"box\", \"tent\"]\n"
        "measures = [\"error\", \"edge-ratio\"]\n" +
        kStill + "[[scene]]\nkind = \"disk\"\nwidth = 24\nheight = 24\ncenter = [12, 12]\nradius = 7\n");
    REQUIRE(rows.size() == 4);
    CHECK(rows[0].number("hit_pixels") > 20);
    CHECK(rows[0].number("hit_pixels") <= rows[0].number("pixels_active"));
    for (std::size_t i = 1; i < 4; ++i) {
      CHECK(rows[i].number("hit_pixels") == 0);
      CHECK(std::isnan(rows[i].number("hit_mse")));
    }
  }

  TEST_CASE("a ratio of sums has the interval of its clusters") {
    const double above[] = {2, 4, 9}, below[] = {1, 2, 3};
    const Ratio ratio = ratio_of_sums(above, below);
    CHECK(ratio.value == 2.5);
    // Deviations -0.5, -1, 1.5 from 2.5 times below; variance sum of squares 3.5 * (3 / 2) / 6^2.
    REQUIRE(ratio.interval.has_value());
    CHECK(ratio.interval->hi - 2.5 == doctest::Approx(student_t95(2) * std::sqrt(3.5 * 1.5) / 6).epsilon(1e-12));
    CHECK_FALSE(ratio_of_sums({above, 1}, {below, 1}).interval.has_value());
  }

  TEST_CASE("discrepancies among the measures are theory's, or root mean squares over sets of the pattern") {
    const Table rows = rows_of(
        "trials = 2\nspp = [16]\nlayout = [\"pixel\", \"image\"]\nimages = \"none\"\npatterns = [\"jittered\", "
        "\"zaremba\", \"dart-throwing:k=10\"]\nmeasures = [\"error\", \"star-l2\", \"edge-l2\"]\n" +
        kStill);
    REQUIRE(rows.size() == 10);
    for (const Row& row : rows) {
      CHECK(row.find("star_l2_3d") == nullptr);
      if (row.text("layout") == "image") {  // no pixel has such a set
        CHECK(std::isnan(row.number("star_l2")));
        CHECK(std::isnan(row.number("edge_l2_error")));
        continue;
      }
      const PatternChoice choice(parse_spec(row.text("pattern"), "test"));
      if (row.text("pattern") == "jittered") {
        CHECK(row.number("star_l2") == std::sqrt(expected_star_l2_squared_jittered(16)));
        CHECK(row.number("star_l2_error") == 0);
        continue;
      }
      const std::uint32_t sets = choice.varies() ? 100 : 1;
      double star = 0, edge = 0;
      for (std::uint32_t t = 0; t < sets; ++t) {
        std::vector<double> x(16), y(16);
        Pattern(choice, 16, Draw{1, t}).fill_set({x, y});
        star += star_l2_squared({x, y}) / sets;
        edge += edge_l2_squared({x, y}, LineLaw::isotropic) / sets;
      }
      // Sums of 100 numbers in two orders: 100 half ulps.
      CHECK(row.number("star_l2") == doctest::Approx(std::sqrt(star)).epsilon(100 * 0x1p-53));
      CHECK(row.number("edge_l2") == doctest::Approx(std::sqrt(edge)).epsilon(100 * 0x1p-53));
      CHECK((row.number("edge_l2_error") > 0) == choice.varies());
    }
  }

  TEST_CASE("errors that are a power of a discrepancy correlate wholly with it, and others less") {
    Table summary;
    for (const double n : {4.0, 16.0, 64.0}) {
      for (const double quality : {1.0, 1.5, 2.5}) {
        Row row;
        row.set("scene", std::string("a"));
        row.set("filter", std::string("box"));
        row.set("estimator", std::string("ratio"));
        row.set("layout", std::string("pixel"));
        row.set("spp", n);
        row.set("star_l2", quality / n);
        row.set("edge_l2", 1 / (quality * n));
        row.set("rmse_active", 3 * std::pow(quality / n, 0.75));
        summary.push_back(row);
      }
    }
    const Table table = correlate_discrepancies(summary);
    REQUIRE(table.size() == 2);
    CHECK(table[0].text("discrepancy") == "star_l2");
    CHECK(table[0].number("points") == 9);
    // Sums of nine numbers of order 1: rounding of some 1e-15.
    CHECK(table[0].number("correlation") == doctest::Approx(1).epsilon(1e-13));
    CHECK(table[0].number("same_n_correlation") == doctest::Approx(1).epsilon(1e-13));
    CHECK(table[0].number("slope") == doctest::Approx(0.75).epsilon(1e-13));
    CHECK(table[1].number("correlation") < 0.95);
    CHECK(table[1].number("same_n_correlation") == doctest::Approx(-1).epsilon(1e-13));
  }

  TEST_CASE("a scene's own lists choose from the study's, and what is not there is refused with the choices") {
    const std::string head =
        "trials = 2\nspp = [4, 16]\nlayout = [\"pixel\", \"image\"]\npatterns = [\"jittered\", \"zaremba\"]\n";
    CHECK(plan(parse(head + kStill)).size() == 2 * 2 * (2 + 1));
    CHECK(plan(parse(head + kStill + "spp = [16]\n")).size() == 2 * (2 + 1));
    CHECK(plan(parse(head + kStill + "patterns = [\"zaremba\"]\nlayout = \"image\"\n")).size() == 2);
    // A count that only another scene's pattern has.
    const std::string odd = "trials = 1\nspp = [4, 5]\npatterns = [\"jittered\", \"zaremba\"]\n";
    CHECK(message_of([&] { plan(parse(odd + kStill)); }).find("nearest") != std::string::npos);
    CHECK(plan(parse(odd + kStill + "spp = [4]\n")).size() == 2);
    CHECK(message_of([&] { parse(head + kStill + "spp = [8]\n"); }).find("4, 16") != std::string::npos);
    CHECK(message_of([&] { parse(head + kStill + "patterns = [\"random\"]\n"); }).find("jittered, zaremba") !=
          std::string::npos);
    CHECK(message_of([&] { parse(head + kStill + "spp = []\n"); }).find("empty") != std::string::npos);
  }
}
