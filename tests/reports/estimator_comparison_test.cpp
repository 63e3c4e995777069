// Estimators side by side in the report.
#include "reports/estimator_comparison.h"

#include <doctest/doctest.h>

#include <string>

#include "reports/markdown.h"

namespace moire {
namespace {

Table rows_of(std::initializer_list<const char*> estimators) {
  Table rows;
  double error = 0.1;
  for (const char* estimator : estimators) {
    for (const std::int64_t spp : {4, 16}) {
      Row row;
      row.set("scene", std::string("edge"));
      row.set("pattern", std::string("jittered"));
      row.set("spp", spp);
      row.set("filter", std::string("tent"));
      row.set("estimator", std::string(estimator));
      row.set("trial", std::int64_t{0});
      row.set("mse_active", error * error);
      row.set("rmse_active", error);
      row.set("status", std::string("ok"));
      rows.push_back(row);
    }
    error *= 2.5;
  }
  return rows;
}

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("estimators stand side by side, with their errors over the first one's") {
    const Table rows = rows_of({"ratio", "importance", "importance:form=ratio"});
    const Summary summary = summarize(rows);
    const std::string text = estimator_comparison(summary);
    CAPTURE(text);
    CHECK(text.find("### Estimators on `edge`, `jittered`") != std::string::npos);
    CHECK(text.find("| filter | samples per pixel | `ratio` | `importance` | `importance:form=ratio` |") !=
          std::string::npos);
    CHECK(text.find("| `tent` | 16 | 1.00e-01 | 2.50e-01 (x 2.50) | 6.25e-01 (x 6.25) |") != std::string::npos);
    CHECK(markdown_report("s", rows, summary).find(text) != std::string::npos);
    CHECK(text.find("`importance:form=ratio` divides the signed sum by the sum of the signs") != std::string::npos);
    CHECK(estimator_comparison(summarize(rows_of({"ratio", "unnormalised"}))).find("sum of the signs") ==
          std::string::npos);
  }

  TEST_CASE("a study of one estimator has no such comparison") {
    CHECK(estimator_comparison(summarize(rows_of({"ratio"}))).empty());
    CHECK(estimator_comparison(summarize({})).empty());
  }
}

}  // namespace moire
