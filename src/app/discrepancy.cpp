// moire discrepancy: how unevenly a pattern's points, or anybody's, fill the square or the cube.
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include "app/commands.h"
#include "app/output.h"
#include "core/parallel.h"
#include "reports/json.h"
#include "reports/text_table.h"
#include "study/discrepancy_run.h"
#include "study/discrepancy_summary.h"
#include "study/point_sets.h"

namespace moire {
namespace {

std::vector<DiscrepancyChoice> choices(const DiscrepancyOptions& options) {
  Given defaults;
  const auto add = [&](const char* key, const std::string& text, const char* place) {
    if (text.empty()) return;
    Value value;
    value.text = text;
    value.place = place;
    defaults.emplace_back(key, value);
  };
  add("method", options.method, "--method");
  add("tests", options.lines, "--lines");
  add("radius", options.radius, "--radius");
  std::vector<DiscrepancyChoice> measures;
  for (const std::string& text : options.measures) measures.emplace_back(parse_spec(text, "--measure"), defaults);
  for (const auto& [key, value] : defaults) {
    const auto takes = [&key = key](const DiscrepancyChoice& measure) {
      if (key == "tests" && !measure.is_monte_carlo()) return false;
      const auto& params = measure.info().params;
      return std::any_of(params.begin(), params.end(), [&](const Param& p) { return p.name == key; });
    };
    if (std::none_of(measures.begin(), measures.end(), takes)) {
      throw Error(value.place, key == "tests" ? "is of random tests; give --method monte-carlo, too"
                                              : "does not go with any of these measures; leave it out");
    }
  }
  return measures;
}

// One row per pattern, n and measure: mean over sets of T (or D), sqrt(mean T^2), standard error of the mean; of one
// set by random tests test_error, the error that these leave.
Row summary_row(const std::string& pattern, std::int64_t n, int dims, const DiscrepancyChoice& measure,
                const std::vector<double>& values, double test_error) {
  const DiscrepancyMean mean = mean_over_sets(values);
  Row row;
  row.set("pattern", pattern);
  row.set("n", n);
  row.set("dims", std::int64_t{dims});
  row.set("measure", measure.text());
  row.set("method", std::string(measure.method()));
  row.set("trials", static_cast<std::int64_t>(values.size()));
  row.set("mean", finite_cell(mean.mean));
  row.set("rms", finite_cell(mean.rms));
  row.set("stderr", finite_cell(mean.standard_error));
  if (values.size() == 1 && measure.is_monte_carlo()) row.set("test_error", finite_cell(test_error));
  return row;
}

Table of_patterns(const DiscrepancyOptions& options, const std::vector<DiscrepancyChoice>& measures) {
  DiscrepancyBlock block;
  block.trials = options.trials;
  block.dims = {options.dims == 0 ? 2 : options.dims};
  block.n = options.n;
  block.measures = measures;
  for (const std::string& text : options.patterns) block.patterns.emplace_back(parse_spec(text, "PATTERN"));
  DiscrepancyStudy study;
  study.seed = options.seed;
  study.images = false;
  study.blocks.push_back(std::move(block));
  const DiscrepancyPlan planned = plan(study);
  const Results results = run(study, planned, {});

  Table rows;
  for (const DiscrepancyGroup& group : planned.groups) {
    const DiscrepancyBlock& of = study.blocks[group.block];
    for (std::size_t m = 0; m < measures.size(); ++m) {
      std::vector<double> values;
      double test_error = 0;
      for (std::size_t t = 0; t < group.trials; ++t) {
        const Row& row = results.rows[group.first_row + m * group.trials + t];
        values.push_back(row.number("discrepancy"));
        test_error = row.number("discrepancy_error");
      }
      rows.push_back(
          summary_row(of.patterns[group.pattern].text(), of.n[group.n], of.dims[0], measures[m], values, test_error));
    }
  }
  return rows;
}

// Sets of one size are trials of each other.
Table of_points(const DiscrepancyOptions& options, const std::vector<DiscrepancyChoice>& measures) {
  const std::vector<PointSet> sets = read_point_sets(options.points);
  const std::string name = options.points == "-" ? "standard input" : options.points;
  const int columns = sets.front().t.empty() ? 2 : 3, dims = options.dims == 0 ? columns : options.dims;
  if (dims > columns) throw Error(name, "has points x,y; --dims 3 needs x,y,t");
  std::vector<std::size_t> sizes;
  std::map<std::size_t, std::vector<std::size_t>> sets_of;
  for (std::size_t i = 0; i < sets.size(); ++i) {
    const std::size_t n = sets[i].x.size();
    if (sets_of[n].empty()) sizes.push_back(n);
    sets_of[n].push_back(i);
  }
  for (const DiscrepancyChoice& measure : measures)
    for (const std::size_t n : sizes) measure.require(static_cast<std::int64_t>(n), dims);

  Table rows;
  for (const std::size_t n : sizes) {
    const std::vector<std::size_t>& same = sets_of[n];
    for (const DiscrepancyChoice& measure : measures) {
      std::vector<Discrepancy> found(same.size());
      parallel_for(same.size(), [&](std::size_t i) {
        const PointSet& set = sets[same[i]];
        PointView view{set.x, set.y};
        if (dims == 3) view.t = set.t;
        found[i] = measure(view, pixel_key(draw_hash(options.seed, static_cast<std::uint32_t>(i)), {}));
      });
      std::vector<double> values;
      for (const Discrepancy& d : found) values.push_back(d.value);
      rows.push_back(summary_row(name, static_cast<std::int64_t>(n), dims, measure, values, found.back().error));
    }
  }
  return rows;
}

std::string text_of(const Table& rows) {
  const auto number = [](const Row& row, const char* name, const char* format) {
    const double value = row.number(name);
    return std::isfinite(value) ? fmt::format(fmt::runtime(format), value) : std::string("-");
  };
  const double none = std::nan("");
  TextLines lines;
  lines.push_back({});
  for (const char* head : {"pattern", "n", "dims", "measure", "method", "trials", "mean", "rms", "stderr"}) {
    lines[0].push_back({head, none});
  }
  for (const Row& row : rows) {
    const bool exact = row.text("method") == "exact";
    lines.push_back({{std::string(row.text("pattern")), none},
                     {number(row, "n", "{:.0f}"), none},
                     {number(row, "dims", "{:.0f}"), none},
                     {std::string(row.text("measure")), none},
                     {std::string(row.text("method")), none},
                     {number(row, "trials", "{:.0f}"), none},
                     {(exact ? "D = " : "T = ") + number(row, "mean", "{:.6g}"), none},
                     {number(row, "rms", "{:.6g}"), none},
                     {std::isfinite(row.number("test_error")) ? number(row, "test_error", "{:.2g} (tests)")
                                                              : number(row, "stderr", "{:.2g}"),
                      none}});
  }
  return text_table(lines, false);
}

}  // namespace

Exit execute(const DiscrepancyOptions& options) {
  const ThreadLimit limit(options.threads);
  const std::vector<DiscrepancyChoice> measures = choices(options);
  const Table rows = options.points.empty() ? of_patterns(options, measures) : of_points(options, measures);
  if (!options.json) {
    print(text_of(rows));
    return Exit::ok;
  }
  std::string text;
  for (const Row& row : rows) {
    Row named;  // the contract's nine
    for (const auto& [name, cell] : row.cells()) {
      if (name != "test_error") named.set(name, cell);
    }
    text += (text.empty() ? "[" : ",\n ") + json_row(named, "");
  }
  print(text + "]\n");
  return Exit::ok;
}

}  // namespace moire
