// Studies of discrepancies: what their files mean, what is refused, and what their runs and summaries say.
#include "study/discrepancy_study.h"

#include <doctest/doctest.h>

#include <cmath>
#include <sstream>
#include <string>
#include <tuple>
#include <vector>

#include "core/parallel.h"
#include "measure/discrepancy/edge_l2.h"
#include "measure/discrepancy/star_l2.h"
#include "message.h"
#include "study/discrepancy_run.h"
#include "study/discrepancy_summary.h"
#include "study/published.h"

using namespace moire;

namespace {

DiscrepancyStudy parse(const std::string& text) {
  const Node root = parse_toml(text, "d.toml");
  REQUIRE(is_discrepancy_study(root));
  return parse_discrepancy_study(root, text, "d");
}

std::string refusal(const std::string& text) {
  return message_of([&] { plan(parse(text)); });
}

PatternChoice pattern_of(const std::string& text) { return PatternChoice(parse_spec(text, "test")); }
DiscrepancyChoice measure_of(const std::string& text) { return DiscrepancyChoice(parse_spec(text, "test")); }

const std::string kSmall = "trials = 3\nn = [4, 16]\npatterns = [\"jittered\", \"zaremba\"]\n";

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("a file without scenes that names points or discrepancies is a study of discrepancies") {
    CHECK(is_discrepancy_study(parse_toml("measures = [\"edge-l2-printed:tests=10\"]", "d")));
    CHECK(is_discrepancy_study(parse_toml("n = [4]", "d")));
    CHECK(is_discrepancy_study(parse_toml("[[discrepancy]]\nn = [4]", "d")));
    CHECK_FALSE(is_discrepancy_study(parse_toml("measures = [\"error\"]", "d")));
    CHECK_FALSE(is_discrepancy_study(parse_toml("n = [4]\n[[scene]]\nkind = \"edge\"", "d")));
  }

  TEST_CASE("keys outside of tables are the defaults of the tables") {
    const DiscrepancyStudy study =
        parse(kSmall +
              "name = \"x\"\nseed = 7\n[[discrepancy]]\nmeasures = [\"star-l2\"]\n[[discrepancy]]\nn = "
              "[9]\ntrials = 5\nmeasures = [\"disk-l2\"]\n");
    CHECK(study.name == "x");
    CHECK(study.seed == 7);
    REQUIRE(study.blocks.size() == 2);
    CHECK(study.blocks[0].trials == 3);
    CHECK(study.blocks[0].n == std::vector<int>{4, 16});
    CHECK(study.blocks[1].trials == 5);
    CHECK(study.blocks[1].n == std::vector<int>{9});
    CHECK(study.blocks[1].patterns.size() == 2);
    // Jittered points vary: 3 trials of 2 sizes, and 5 of one; Zaremba's one each.
    CHECK(plan(study).rows == 2 * 3 + 2 + 5 + 1);
  }

  TEST_CASE("what is wrong is refused with its place and the choices") {
    CHECK(refusal("n = [4]\nmeasures = [\"star-l2\"]\n").find("no patterns") != std::string::npos);
    CHECK(refusal(kSmall).find("no measures") != std::string::npos);
    CHECK(refusal(kSmall + "measures = [\"star-l3\"]\n").find("star-l2") != std::string::npos);
    CHECK(refusal(kSmall + "measures = [\"star-l2\"]\ndims = [3]\n").find("jittered-random-time") != std::string::npos);
    CHECK(refusal("n = [4]\npatterns = [\"zaremba\"]\nmeasures = [\"edge-l2\"]\ndims = [3]\n").find("star-l2") !=
          std::string::npos);
    CHECK(refusal("n = [5]\npatterns = [\"jittered\"]\nmeasures = [\"star-l2\"]\n").find("nearest: 4, 9") !=
          std::string::npos);
    CHECK(refusal(kSmall + "measures = [\"star-l2:counted=without-first\"]\n").find("monte-carlo") !=
          std::string::npos);
    CHECK(refusal(kSmall + "measures = [\"star-linf:method=monte-carlo\"]\n").find("star-linf") != std::string::npos);
    CHECK(refusal(kSmall + "measures = [\"disk-l2:radius=1e-170\"]\n").find("too small") != std::string::npos);
    CHECK(refusal("n = [4194304]\ndims = [3]\npatterns = [\"random\"]\nmeasures = [\"star-l2\"]\n").find("2097152") !=
          std::string::npos);
    CHECK(refusal(kSmall + "measures = [\"disk-l2:radius=0.6\"]\n").find("0.5") != std::string::npos);
    CHECK(refusal("n = [300000]\npatterns = [\"random\"]\nmeasures = [\"edge-l2\"]\n").find("at most 262144") !=
          std::string::npos);
    CHECK(refusal(kSmall + "measures = [\"star-l2\"]\nspp = [4]\n").find("d.toml:5:1") == 0);
    CHECK(refusal(kSmall + "measures = [\"star-l2\"]\n[[discrepancy]]\n[[discrepancy]]\n").find("twice") !=
          std::string::npos);
  }

  TEST_CASE("rows hold the discrepancies of the sets of moire points, for any number of threads") {
    const DiscrepancyStudy study =
        parse(kSmall + "measures = [\"star-l2\", \"edge-l2\", \"edge-l2:method=monte-carlo,tests=50\"]\n");
    const DiscrepancyPlan planned = plan(study);
    const Results all = run(study, planned, {});
    REQUIRE(all.complete);
    REQUIRE(all.rows.size() == planned.rows);
    const Results one = [&] {
      const ThreadLimit limit(1);
      return run(study, planned, {});
    }();
    std::size_t at = 0;
    for (const DiscrepancyGroup& group : planned.groups) {
      const PatternChoice& pattern = study.blocks[0].patterns[group.pattern];
      const int n = study.blocks[0].n[group.n];
      for (std::size_t m = 0; m < 3; ++m) {
        for (std::uint32_t t = 0; t < group.trials; ++t, ++at) {
          std::vector<double> x(static_cast<std::size_t>(n)), y(x.size());
          Pattern(pattern, n, Draw{study.seed, t}).fill_set({x, y});
          const double value = all.rows[at].number("discrepancy");
          if (m == 0) CHECK(value == std::sqrt(star_l2_squared({x, y})));
          if (m == 1) CHECK(value == std::sqrt(edge_l2_squared({x, y}, LineLaw::isotropic)));
          CHECK(value == one.rows[at].number("discrepancy"));
          CHECK(std::isfinite(all.rows[at].number("discrepancy_error")) == (m == 2));
        }
      }
    }
  }

  TEST_CASE("a run that goes on keeps the rows that are there and computes the others") {
    const DiscrepancyStudy study = parse(kSmall + "measures = [\"star-l2\", \"disk-l2\"]\n");
    const DiscrepancyPlan planned = plan(study);
    const Results whole = run(study, planned, {});
    Table earlier = whole.rows;
    for (std::size_t i = 0; i < earlier.size(); i += 3) earlier[i] = Row();
    std::size_t told = 0;
    DiscrepancyObserver observer;
    observer.row = [&](const Row&) { ++told; };
    const Results again = run(study, planned, observer, earlier);
    CHECK(told == (planned.rows + 2) / 3);
    REQUIRE(again.rows.size() == whole.rows.size());
    for (std::size_t i = 0; i < whole.rows.size(); ++i) {
      CHECK(again.rows[i].number("discrepancy") == whole.rows[i].number("discrepancy"));
    }
    observer.stop = [&] { return told >= planned.rows / 2; };
    told = 0;
    const Results stopped = run(study, planned, observer);
    CHECK_FALSE(stopped.complete);
    CHECK(stopped.rows.size() == told);
  }

  TEST_CASE("a summary has the mean, the root mean square and the standard error of its rows") {
    const DiscrepancyMean mean = mean_over_sets({3, 4, 5});
    CHECK(mean.mean == 4);
    CHECK(mean.rms == std::sqrt(50.0 / 3));
    CHECK(mean.standard_error == std::sqrt(2.0 / 2 / 3));
    CHECK(std::isnan(mean_over_sets({3}).standard_error));
  }

  TEST_CASE("the paper's cells that are exact come out digit for digit, and doubtful ones say why") {
    const DiscrepancyStudy study = parse(
        "trials = 20\nn = [16, 256, 1600]\n[[discrepancy]]\npatterns = [\"zaremba\", \"random\"]\nmeasures = "
        "[\"star-l2\"]\n[[discrepancy]]\npatterns = [\"zaremba\"]\ndims = [3]\nmeasures = [\"star-l2\"]\n");
    const DiscrepancyPlan planned = plan(study);
    const DiscrepancySummary summary = summarize(study, planned, run(study, planned, {}).rows);
    int exact = 0;
    for (const Row& row : summary.rows) {
      CHECK(std::isfinite(row.number("paper")));
      if (row.text("pattern") == "zaremba") {
        CHECK(row.flag("paper_as_printed"));
        ++exact;
      } else {
        CHECK(row.text("paper_is") == "rms");
        CHECK(!row.text("paper_doubt").empty());
        // 20 sets: the formula is in the table, so that only our own error counts. z of 6 numbers; 4 is one in 2,600.
        CHECK(std::fabs(row.number("paper_z")) < 4);
        CHECK(std::fabs(row.number("expected_z")) < 4);
      }
    }
    CHECK(exact == 6);
  }

  TEST_CASE("the paper's four tables are as it prints them") {
    // By table: pattern and its values at 16, 256 and 1600 points, in the paper's order.
    const std::vector<std::tuple<std::string, std::string, int, std::string>> tables = {
        {"star-l2", "zaremba", 2, "0.0358 0.00255 0.000438"},
        {"star-l2", "jittered", 2, "0.0489 0.00633 0.00160"},
        {"star-l2", "dart-throwing", 2, "0.0490 0.00799 0.00254"},
        {"star-l2", "n-rooks", 2, "0.0461 0.0101 0.00391"},
        {"star-l2", "random", 2, "0.0932 0.0233 0.00932"},
        {"star-l2", "zaremba", 3, "0.0393 0.00376 0.000761"},
        {"star-l2", "scan-time", 3, "0.0473 0.00721 0.00235"},
        {"star-l2", "jittered-random-time", 3, "0.0580 0.0126 0.00512"},
        {"star-l2", "random", 3, "0.0741 0.0185 0.00741"},
        {"disk-l2", "dart-throwing", 2, "0.0840 0.0120 0.00368"},
        {"disk-l2", "jittered", 2, "0.0994 0.0165 0.00394"},
        {"disk-l2", "zaremba", 2, "0.0855 0.0160 0.00511"},
        {"disk-l2", "random", 2, "0.104 0.0239 0.00993"},
        {"disk-l2", "n-rooks", 2, "0.0908 0.0224 0.0104"},
        {"edge-l2-printed", "zaremba", 2, "0.0504 0.00478 0.00111"},
        {"edge-l2-printed", "jittered", 2, "0.0538 0.00595 0.00146"},
        {"edge-l2-printed", "dart-throwing", 2, "0.0613 0.00767 0.00241"},
        {"edge-l2-printed", "n-rooks", 2, "0.0637 0.0123 0.00488"},
        {"edge-l2-printed", "random", 2, "0.0924 0.0224 0.00866"}};
    for (const auto& [measure, pattern, dims, values] : tables) {
      CAPTURE(measure);
      CAPTURE(pattern);
      std::istringstream stream(values);
      for (const int n : {16, 256, 1600}) {
        std::string word;
        stream >> word;
        const auto cell = published(pattern_of(pattern), n, dims, measure_of(measure));
        REQUIRE(cell.has_value());
        CHECK(cell->value == std::stod(word));
        const auto decimals = static_cast<int>(word.size() - word.find('.')) - 1;
        CHECK(cell->last_digit == doctest::Approx(std::pow(10, -decimals)).epsilon(1e-14));
      }
    }
  }

  TEST_CASE("the paper's values and known rates belong to its own patterns and measures alone") {
    const std::string without = "edge-l2-printed:method=monte-carlo,counted=without-first";
    CHECK_FALSE(published(pattern_of("zaremba"), 64, 2, measure_of("star-l2")).has_value());
    CHECK_FALSE(published(pattern_of("zaremba"), 16, 2, measure_of("star-linf")).has_value());
    CHECK(published(pattern_of("zaremba"), 16, 2, measure_of(without))->doubt.empty());
    CHECK_FALSE(published(pattern_of("zaremba"), 16, 2, measure_of("edge-l2-printed"))->doubt.empty());
    for (const char* other : {"zaremba:instance=shift", "jittered:amount=0.5", "jittered:amount=0"}) {
      CHECK_FALSE(published(pattern_of(other), 16, 2, measure_of("star-l2")).has_value());
      CHECK_FALSE(known_exponent(pattern_of(other), 2, measure_of("star-l2")).has_value());
    }
    CHECK(published(pattern_of("dart-throwing:k=10"), 16, 2, measure_of("star-l2")).has_value());
    CHECK_FALSE(published(pattern_of("random"), 16, 2, measure_of("disk-l2:radius=0.1")).has_value());
    CHECK(known_exponent(pattern_of("zaremba"), 2, measure_of("edge-l2"))->at_best);
    CHECK_FALSE(known_exponent(pattern_of("jittered"), 2, measure_of("edge-l2"))->at_best);
  }

  TEST_CASE("one set of a pattern that varies has no z, and random tests of one that does not have theirs") {
    const DiscrepancyStudy study = parse(
        "trials = 1\nn = [16]\npatterns = [\"random\", \"zaremba\"]\nmeasures = [\"edge-l2-printed\", "
        "\"edge-l2-printed:method=monte-carlo,counted=without-first\"]\n");
    const DiscrepancyPlan planned = plan(study);
    for (const Row& row : summarize(study, planned, run(study, planned, {}).rows).rows) {
      const bool varies = row.text("pattern") == "random", random_tests = row.text("method") == "monte-carlo";
      CHECK(std::isfinite(row.number("paper_z")) == (!varies && random_tests));
      CHECK(std::holds_alternative<bool>(*row.find("paper_as_printed")) == (!varies && !random_tests));
      CHECK(std::isnan(row.number("expected_z")));
      // The one cell of table 4 that comes out only without the first point.
      if (!varies && random_tests) CHECK(std::fabs(row.number("paper_z")) < 4);
    }
  }

  TEST_CASE("a slope says of how many sets it is") {
    const DiscrepancyStudy study = parse(
        "patterns = [\"random\"]\nmeasures = [\"star-l2\"]\n[[discrepancy]]\nn = [16, 64]\ntrials = "
        "9\n[[discrepancy]]\nn = [256]\ntrials = 5\n");
    const DiscrepancyPlan planned = plan(study);
    const DiscrepancySummary summary = summarize(study, planned, run(study, planned, {}).rows);
    REQUIRE(summary.slopes.size() == 1);
    CHECK(summary.slopes[0].number("trials") == 5);
    CHECK(summary.slopes[0].number("points") == 3);
  }

  TEST_CASE("the rate of jittered points is theirs, -3/4, and of random ones -1/2") {
    const DiscrepancyStudy study =
        parse("trials = 40\nn = [16, 64, 256]\npatterns = [\"jittered\", \"random\"]\nmeasures = [\"edge-l2\"]\n");
    const DiscrepancyPlan planned = plan(study);
    const DiscrepancySummary summary = summarize(study, planned, run(study, planned, {}).rows);
    REQUIRE(summary.slopes.size() == 2);
    for (const Row& row : summary.slopes) {
      CHECK(row.number("known") == (row.text("pattern") == "jittered" ? -0.75 : -0.5));
      // A 95% interval, and a little more.
      const double half = (row.number("slope_hi") - row.number("slope_lo")) / 2;
      CHECK(std::fabs(row.number("slope") - row.number("known")) < 1.5 * half);
    }
  }
}
