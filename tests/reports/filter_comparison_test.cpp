// Filters side by side, in the report and on a terminal.
#include "reports/filter_comparison.h"

#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "filters/filter.h"
#include "reports/markdown.h"
#include "reports/terminal.h"
#include "study/filter_table.h"

namespace moire {
namespace {

// Filters f0, f1, ... on one scene; the error against coverage falls with the number, the sampling error rises.
Table rows_of(int filters, bool coverage) {
  Table rows;
  for (int i = 0; i < filters; ++i) {
    Row row;
    row.set("scene", std::string("edge"));
    row.set("pattern", std::string("jittered"));
    row.set("spp", std::int64_t{16});
    row.set("filter", "f" + std::to_string(i));
    row.set("estimator", std::string("ratio"));
    row.set("trial", std::int64_t{0});
    row.set("mse_active", 0.01 * (i + 1));
    row.set("rmse_active", 0.1 * (i + 1));
    row.set("mse_all", 0.01 * (i + 1) * (i + 1));
    row.set("rmse_all", 0.1 * (i + 1));
    row.set("status", std::string("ok"));
    if (coverage) {
      row.set("rmse_coverage_all", 0.5 / (i + 1));
      row.set("rmse_filter_all", 0.25 / (i + 1));
      row.set("flat_field_rms", 0.125);
      row.set("overshoot_got", 0.0625);
      row.set("overshoot_exact", 0.03125);
    }
    rows.push_back(row);
  }
  return rows;
}

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("the comparison ranks by total and by sampling error, and shows them side by side") {
    const std::string text = filter_comparison(summarize(rows_of(3, true)));
    CAPTURE(text);
    CHECK(text.find("| 1 | `f2` 1.00 | `f0` 1.00 |") != std::string::npos);
    CHECK(text.find("| 3 | `f0` 3.00 | `f2` 3.00 |") != std::string::npos);
    CHECK(text.find("| `f2` | 8.33e-02 | 0.0312 |") != std::string::npos);
    CHECK(text.find("### Filters on `edge`") < text.find("| `f0` | 2.50e-01"));
  }

  TEST_CASE("a study of one filter, or one that did not measure coverage, has no comparison") {
    CHECK(filter_comparison(summarize(rows_of(1, true))).empty());
    CHECK(filter_comparison(summarize(rows_of(3, false))).empty());
    CHECK(filter_comparison(summarize({})).empty());
  }

  TEST_CASE("many filters stand under each other, few side by side, in the report and on the terminal") {
    for (const int filters : {3, 12}) {
      const Table rows = rows_of(filters, true);
      const Summary summary = summarize(rows);
      const std::string report = markdown_report("s", rows, summary), screen = terminal_tables(summary, false);
      CAPTURE(report);
      CAPTURE(screen);
      const bool many = filters > 6;
      CHECK((report.find("| samples per pixel | `f0` | `f1` |") == std::string::npos) == many);
      CHECK((report.find("| filter \\ samples per pixel | 16 |") != std::string::npos) == many);
      CHECK((screen.find("edge, jittered\n") != std::string::npos) == many);
      CHECK((screen.find("edge, f0\n") == std::string::npos) == many);
      CHECK(screen.find("filters over all scenes, jittered, 16 samples per pixel") == 0);
    }
  }

  TEST_CASE("the metrics of the filters stand in the report if the study measured them") {
    const Table rows = rows_of(2, true);
    const std::vector<Filter> filters{Filter(parse_spec("box", "test")), Filter(parse_spec("mitchell", "test"))};
    const std::string with = markdown_report("s", rows, summarize(rows), filter_table(filters));
    CHECK(with.find("### The filters themselves") != std::string::npos);
    CHECK(with.find("| `mitchell` | 2 |") != std::string::npos);
    CHECK(markdown_report("s", rows, summarize(rows)).find("### The filters themselves") == std::string::npos);
  }
}

}  // namespace moire
