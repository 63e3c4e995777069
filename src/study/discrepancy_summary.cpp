// Means of discrepancies over trials.
#include "study/discrepancy_summary.h"

#include <cmath>
#include <map>
#include <string>
#include <tuple>

#include "measure/statistics.h"
#include "study/published.h"

namespace moire {
namespace {

// Lines per set of the paper's table 4.
constexpr double kPaperTests = 10000;

// How many standard errors a printed value is from ours: theirs has the error of as many sets of the same law, or for a
// pattern that does not vary of as many random tests, and is rounded, which adds the variance of a uniform number. NaN
// where the error is not known, or there is none.
double paper_z(const PublishedValue& paper, const DiscrepancyMean& ours, bool varies, std::size_t trials,
               double test_error, double tests) {
  const double error = !varies ? test_error : paper.is_rms ? ours.square_error / (2 * ours.rms) : ours.standard_error;
  if (!(error > 0)) return std::nan("");
  const double theirs = !varies            ? error * std::sqrt(tests / kPaperTests)
                        : paper.trials > 0 ? error * std::sqrt(static_cast<double>(trials) / paper.trials)
                                           : 0;
  const double all = std::sqrt(error * error + theirs * theirs + paper.last_digit * paper.last_digit / 12);
  return (paper.value - (paper.is_rms ? ours.rms : ours.mean)) / all;
}

using SlopeKey = std::tuple<std::string, std::int64_t, std::string>;

// The values of one pattern, dims and measure by n, in order of trials.
struct Series {
  const PatternChoice* pattern;
  const DiscrepancyChoice* measure;
  std::vector<SlopePoint> points;
};

void add_slope(const SlopeKey& key, Series& series, Table& slopes) {
  if (series.points.size() < 2) return;
  std::size_t trials = series.points.front().mse.size();
  for (const SlopePoint& p : series.points) trials = std::min(trials, p.mse.size());
  for (SlopePoint& p : series.points) p.mse.resize(trials);
  const std::optional<Slope> slope = fit_slope(series.points);
  if (!slope) return;
  const auto& [pattern, dims, measure] = key;
  Row row;
  row.set("pattern", pattern);
  row.set("dims", dims);
  row.set("measure", measure);
  row.set("slope", slope->slope);
  row.set("slope_lo", slope->interval ? Cell(slope->interval->lo) : Cell());
  row.set("slope_hi", slope->interval ? Cell(slope->interval->hi) : Cell());
  row.set("n_min", slope->n_min);
  row.set("n_max", slope->n_max);
  row.set("points", std::int64_t{slope->points});
  const auto known = known_exponent(*series.pattern, static_cast<int>(dims), *series.measure);
  row.set("trials", static_cast<std::int64_t>(trials));
  row.set("known", known ? Cell(known->exponent) : Cell());
  row.set("known_is", known ? Cell(std::string(known->at_best ? "at best" : "as n grows")) : Cell());
  row.set("why", known ? Cell(std::string(known->why)) : Cell());
  slopes.push_back(std::move(row));
}

}  // namespace

DiscrepancySummary summarize(const DiscrepancyStudy& study, const DiscrepancyPlan& plan, const Table& rows) {
  DiscrepancySummary summary;
  std::vector<SlopeKey> order;
  std::map<SlopeKey, Series> series;
  for (const DiscrepancyGroup& group : plan.groups) {
    const DiscrepancyBlock& block = study.blocks[group.block];
    const PatternChoice& pattern = block.patterns[group.pattern];
    const int n = block.n[group.n], dims = block.dims[group.dims];
    for (std::size_t m = 0; m < block.measures.size(); ++m) {
      const DiscrepancyChoice& measure = block.measures[m];
      std::vector<double> values;
      double test_error = 0;  // of the last one
      for (std::size_t t = 0; t < group.trials; ++t) {
        const std::size_t at = group.first_row + m * group.trials + t;
        values.push_back(rows[at].number("discrepancy"));
        test_error = rows[at].number("discrepancy_error");
      }
      const bool varies = pattern.varies(dims == 3);
      const DiscrepancyMean mean = mean_over_sets(values);
      const auto dof = static_cast<std::int64_t>(values.size()) - 1;
      Row row;
      row.set("pattern", pattern.text());
      row.set("n", std::int64_t{n});
      row.set("dims", std::int64_t{dims});
      row.set("measure", measure.text());
      row.set("method", std::string(measure.method()));
      row.set("trials", static_cast<std::int64_t>(values.size()));
      row.set("mean", finite_cell(mean.mean));
      const double half = dof > 0 ? student_t95(dof) * mean.standard_error : std::nan("");
      row.set("mean_lo", finite_cell(mean.mean - half));
      row.set("mean_hi", finite_cell(mean.mean + half));
      row.set("rms", finite_cell(mean.rms));
      row.set("stderr", finite_cell(mean.standard_error));
      const std::optional<double> expected = measure.expected_square(pattern, n, dims);
      row.set("expected_rms", expected ? Cell(std::sqrt(*expected)) : Cell());
      row.set("expected_z",
              expected && dof > 0 ? finite_cell((mean.rms * mean.rms - *expected) / mean.square_error) : Cell());
      const auto paper = published(pattern, n, dims, measure);
      row.set("table", paper ? Cell(std::int64_t{paper->table}) : Cell());
      row.set("paper", paper ? Cell(paper->value) : Cell());
      row.set("paper_is", paper ? Cell(std::string(paper->is_rms ? "rms" : "mean")) : Cell());
      const auto tests = static_cast<double>(measure.is_monte_carlo() ? measure.tests() : 0);
      row.set("paper_z", paper ? finite_cell(paper_z(*paper, mean, varies, values.size(), test_error, tests)) : Cell());
      row.set("paper_as_printed", paper && !varies && !measure.is_monte_carlo()
                                      ? Cell(std::fabs(mean.mean - paper->value) <= paper->last_digit / 2)
                                      : Cell());
      row.set("paper_doubt", paper && !paper->doubt.empty() ? Cell(std::string(paper->doubt)) : Cell());
      summary.rows.push_back(std::move(row));

      if (!measure.info().is_square) continue;
      const SlopeKey key{pattern.text(), dims, measure.text()};
      const auto [at, is_new] = series.try_emplace(key, Series{&pattern, &measure, {}});
      if (is_new) order.push_back(key);
      SlopePoint point{static_cast<double>(n), {}};
      for (const double v : values) point.mse.push_back(v * v);
      at->second.points.push_back(std::move(point));
    }
  }
  for (const SlopeKey& key : order) add_slope(key, series.at(key), summary.slopes);
  return summary;
}

}  // namespace moire
