// Raw rows to summary rows and convergence rates.
#include "study/summary.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include "core/args.h"
#include "measure/statistics.h"

namespace moire {
namespace {

// The raw rows of one scene, pattern, spp, filter and estimator: its trials.
struct Case {
  std::vector<const Row*> trials;
  std::size_t series = 0;  // index into the list of series
  double spp = 0;
  bool limited = false;
};

// The cases of one scene, pattern, filter and estimator.
struct Series {
  std::vector<std::size_t> cases;  // by first appearance
};

constexpr std::string_view kSeriesKey[] = {"scene", "pattern", "filter", "estimator"};

std::vector<std::string> series_key(const Row& row) {
  std::vector<std::string> key;
  for (const std::string_view name : kSeriesKey) key.emplace_back(row.text(name));
  return key;
}

bool counts(const Row& row) {
  const std::string_view status = row.text("status");
  return (status.empty() || status == "ok") && std::isfinite(row.number("rmse_active"));
}

// Mean squared errors of the trials, in order; from rmse where mse itself is not there.
std::vector<double> mse_of(const Case& c, const std::string& region) {
  std::vector<double> mse;
  for (const Row* row : c.trials) {
    const double direct = row->number("mse_" + region), rmse = row->number("rmse_" + region);
    mse.push_back(std::isfinite(direct) ? direct : rmse * rmse);
  }
  return mse;
}

void set_finite(Row& row, std::string_view name, double value) {
  row.set(name, std::isfinite(value) ? Cell(value) : Cell());
}

void set_interval(Row& row, const std::string& name, const std::optional<Interval>& interval) {
  row.set(name + "_lo", interval ? Cell(interval->lo) : Cell());
  row.set(name + "_hi", interval ? Cell(interval->hi) : Cell());
}

// Sums of whole numbers stay whole numbers.
void set_sum(Row& row, std::string_view name, const Case& c) {
  std::int64_t sum = 0;
  for (const Row* trial : c.trials) {
    const Cell* cell = trial->find(name);
    const auto* value = cell == nullptr ? nullptr : std::get_if<std::int64_t>(cell);
    if (value == nullptr) {
      row.set(name, {});
      return;
    }
    sum += *value;
  }
  row.set(name, sum);
}

void set_largest(Row& row, std::string_view name, const Case& c) {
  double largest = std::nan("");
  for (const Row* trial : c.trials) largest = std::fmax(largest, trial->number(name));
  set_finite(row, name, largest);
}

void set_last(Row& row, std::string_view name, const Case& c) {
  Cell last;
  for (const Row* trial : c.trials) {
    const Cell* cell = trial->find(name);
    if (cell != nullptr && !std::holds_alternative<std::monostate>(*cell)) last = *cell;
  }
  row.set(name, std::move(last));
}

double trial_of(const Row& row) {
  const double trial = row.number("trial");
  return std::isfinite(trial) ? trial : 0;
}

std::vector<double> trial_numbers(const Case& c) {
  std::vector<double> numbers;
  for (const Row* trial : c.trials) numbers.push_back(trial_of(*trial));
  return numbers;
}

void copy_cell(const Row& from, std::string_view name, Row& to, std::string_view new_name) {
  const Cell* cell = from.find(name);
  to.set(new_name, cell == nullptr ? Cell() : *cell);
}

Row summary_row(const Case& c) {
  const Row& first = *c.trials.front();
  Row row;
  for (const std::string_view name : {"scene", "pattern", "spp", "filter", "estimator"})
    copy_cell(first, name, row, name);
  row.set("n_trials", static_cast<std::int64_t>(c.trials.size()));
  for (const std::string region : {"active", "all"}) {
    const std::vector<double> mse = mse_of(c, region);
    const auto interval = rms_interval(mse);
    set_finite(row, "rmse_" + region, rms_over_trials(mse));
    set_interval(row, "rmse_" + region, interval);
    if (region == "active") row.set("ci_method", interval ? Cell(std::string(kRmsMethod)) : Cell());
  }
  set_largest(row, "max_abs_active", c);
  double bias = 0;
  for (const Row* trial : c.trials) bias += trial->number("bias_active");
  set_finite(row, "bias_active", bias / static_cast<double>(c.trials.size()));
  for (const std::string_view name : {"bias_sq_active", "variance_active", "pixels_total", "pixels_active"}) {
    set_last(row, name, c);
  }
  for (const std::string_view name : {"samples_total", "samples_evaluated", "fallbacks"}) set_sum(row, name, c);
  set_largest(row, "error_bound", c);
  row.set("reference_limited", c.limited);
  return row;
}

// The rate of one series; an empty row when there is none. The points are the cases in rising spp.
Row slope_row(const Series& series, const std::vector<Case>& cases) {
  std::vector<const Case*> sorted;
  for (const std::size_t i : series.cases) sorted.push_back(&cases[i]);
  std::stable_sort(sorted.begin(), sorted.end(), [](const Case* a, const Case* b) { return a->spp < b->spp; });
  // Points need the same trials: those of the first case with the most of them.
  std::vector<double> trials;
  for (const Case* c : sorted) {
    if (c->trials.size() > trials.size()) trials = trial_numbers(*c);
  }

  std::string left_out;
  std::vector<SlopePoint> points;
  for (const Case* c : sorted) {
    SlopePoint point{c->spp, mse_of(*c, "active")};
    const char* reason = c->limited                          ? "reference limited"
                         : !(c->spp > 0)                     ? "no sample count"
                         : trial_numbers(*c) != trials       ? "other trials"
                         : !(rms_over_trials(point.mse) > 0) ? "no error"
                                                             : nullptr;
    if (reason == nullptr) {
      points.push_back(std::move(point));
    } else {
      left_out += (left_out.empty() ? "" : ", ") + shortest(c->spp) + " (" + reason + ")";
    }
  }
  const std::optional<Slope> slope = fit_slope(points);
  Row row;
  if (!slope) return row;
  for (const std::string_view name : kSeriesKey) copy_cell(*sorted.front()->trials.front(), name, row, name);
  row.set("slope", slope->slope);
  set_interval(row, "slope", slope->interval);
  row.set("ci_method", slope->interval ? Cell(std::string(kSlopeMethod)) : Cell());
  row.set("n_trials", static_cast<std::int64_t>(trials.size()));
  row.set("spp_min", static_cast<std::int64_t>(slope->n_min));
  row.set("spp_max", static_cast<std::int64_t>(slope->n_max));
  row.set("n_spp", static_cast<std::int64_t>(slope->points));
  row.set("left_out", left_out.empty() ? Cell() : Cell(left_out));
  return row;
}

}  // namespace

Summary summarize(const Table& rows) {
  std::vector<Case> cases;
  std::vector<Series> all_series;
  std::map<std::vector<std::string>, std::size_t> series_index;
  std::map<std::pair<std::size_t, double>, std::size_t> case_index;
  for (const Row& row : rows) {
    if (!counts(row)) continue;
    const auto [s, new_series] = series_index.try_emplace(series_key(row), all_series.size());
    if (new_series) all_series.emplace_back();
    const double spp = std::isfinite(row.number("spp")) ? row.number("spp") : 0;
    const auto [c, new_case] = case_index.try_emplace({s->second, spp}, cases.size());
    if (new_case) {
      cases.push_back({{}, s->second, spp, false});
      all_series[s->second].cases.push_back(c->second);
    }
    cases[c->second].trials.push_back(&row);
    cases[c->second].limited |= row.flag("reference_limited");
  }
  // Trials pair up across sample counts by their place, so their order must be that of their numbers.
  for (Case& c : cases) {
    std::stable_sort(c.trials.begin(), c.trials.end(),
                     [](const Row* a, const Row* b) { return trial_of(*a) < trial_of(*b); });
  }

  Summary summary;
  std::vector<Row> slopes;
  for (const Series& series : all_series) {
    slopes.push_back(slope_row(series, cases));
    if (!slopes.back().cells().empty()) summary.slopes.push_back(slopes.back());
  }
  for (const Case& c : cases) {
    Row row = summary_row(c);
    const Row& slope = slopes[c.series];
    for (const std::string_view name : {"slope", "slope_lo", "slope_hi"}) copy_cell(slope, name, row, name);
    for (const std::string_view name : {"ci_method", "spp_min", "spp_max", "left_out"}) {
      copy_cell(slope, name, row, "slope_" + std::string(name));
    }
    summary.rows.push_back(std::move(row));
  }
  return summary;
}

}  // namespace moire
