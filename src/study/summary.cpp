// Raw rows to summary rows and convergence rates.
#include "study/summary.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include "core/args.h"
#include "measure/statistics.h"
#include "study/columns.h"
#include "study/discrepancy_correlation.h"
#include "study/discrepancy_measure.h"
#include "study/filter_ranking.h"
#include "study/noise_ranking.h"
#include "study/scene_file.h"

namespace moire {
namespace {

// The raw rows of one scene or family, pattern, spp, filter and estimator, by line and trial. A scene of its own has
// the line 0 alone.
struct Case {
  std::vector<const Row*> rows;
  std::size_t series = 0;  // index into the list of series
  double spp = 0;
  bool family = false;
};

// The cases of one scene, pattern, filter and estimator.
struct Series {
  std::vector<std::size_t> cases;  // by first appearance
};

constexpr std::string_view kSeriesKey[] = {"scene", "pattern", "filter", "estimator", "layout"};

std::vector<std::string> series_key(const Row& row) {
  std::vector<std::string> key;
  for (const std::string_view name : kSeriesKey) key.emplace_back(row.text(name));
  key[0] = scene_family(key[0]);
  return key;
}

bool counts(const Row& row) {
  const std::string_view status = row.text("status");
  return (status.empty() || status == "ok") && std::isfinite(row.number("rmse_active"));
}

double trial_of(const Row& row) {
  const double trial = row.number("trial");
  return std::isfinite(trial) ? trial : 0;
}

// Which line and trial a row is.
std::pair<std::int64_t, double> place_of(const Row& row) { return {line_number(row.text("scene")), trial_of(row)}; }

std::vector<std::pair<std::int64_t, double>> places_of(const Case& c) {
  std::vector<std::pair<std::int64_t, double>> places;
  for (const Row* row : c.rows) places.push_back(place_of(*row));
  return places;
}

// From rmse where mse itself is not there.
double mse_of(const Row& row, const std::string& region) {
  const double direct = row.number("mse_" + region), rmse = row.number("rmse_" + region);
  return std::isfinite(direct) ? direct : rmse * rmse;
}

double pixels_of(const Row& row, const std::string& region) {
  const double pixels = row.number("n_pixels_" + region);
  return std::isfinite(pixels) ? pixels : 1;
}

// What is independent in a case: the trials of a scene, or the lines of a family.
struct Errors {
  std::vector<double> mse;      // of a line: the mean over the pixels of all its trials
  std::vector<double> weights;  // of a line: those pixels; none for trials
};

Errors errors_of(const Case& c, const std::string& region) {
  Errors errors;
  for (std::size_t i = 0; i < c.rows.size();) {
    if (!c.family) {
      errors.mse.push_back(mse_of(*c.rows[i++], region));
      continue;
    }
    const std::int64_t line = place_of(*c.rows[i]).first;
    double pixels = 0, sum = 0;
    for (; i < c.rows.size() && place_of(*c.rows[i]).first == line; ++i) {
      const double n = pixels_of(*c.rows[i], region);
      pixels += n;
      sum += n * mse_of(*c.rows[i], region);
    }
    errors.mse.push_back(sum / pixels);
    errors.weights.push_back(pixels);
  }
  return errors;
}

double pooled_rmse(const Case& c, const std::string& region) {
  const Errors errors = errors_of(c, region);
  return rms_over_trials(errors.mse, errors.weights);
}

double largest_of(const Case& c, std::string_view name) {
  double largest = std::nan("");
  for (const Row* row : c.rows) largest = std::fmax(largest, row->number(name));
  return largest;
}

bool is_limited(const Case& c) {
  if (c.family) return reference_limited(pooled_rmse(c, "active"), largest_of(c, "error_bound_rms"));
  return std::any_of(c.rows.begin(), c.rows.end(), [](const Row* row) { return row->flag("reference_limited"); });
}

// The last row of each line that has the cell.
std::vector<const Row*> last_rows(const Case& c, std::string_view name) {
  std::vector<const Row*> last;
  for (const Row* row : c.rows) {
    const Cell* cell = row->find(name);
    if (cell == nullptr || std::holds_alternative<std::monostate>(*cell)) continue;
    if (!last.empty() && place_of(*last.back()).first == place_of(*row).first) last.pop_back();
    last.push_back(row);
  }
  return last;
}

std::int64_t line_count(const Case& c) {
  std::int64_t count = 0;
  for (std::size_t i = 0; i < c.rows.size(); ++i) {
    count += i == 0 || place_of(*c.rows[i]).first != place_of(*c.rows[i - 1]).first;
  }
  return count;
}

// Trials of one line, the same of all in a whole study.
std::int64_t trial_count(const Case& c) { return static_cast<std::int64_t>(c.rows.size()) / line_count(c); }

Cell method(std::string_view name, bool family) { return std::string(name) + (family ? "-by-line" : ""); }

void set_finite(Row& row, std::string_view name, double value) { row.set(name, finite_cell(value)); }

void set_interval(Row& row, const std::string& name, const std::optional<Interval>& interval) {
  row.set(name + "_lo", interval ? Cell(interval->lo) : Cell());
  row.set(name + "_hi", interval ? Cell(interval->hi) : Cell());
}

// Sums of whole numbers stay whole numbers; empty when a row has none.
void set_sum(Row& to, std::string_view name, const std::vector<const Row*>& rows) {
  std::int64_t sum = 0;
  for (const Row* row : rows) {
    const Cell* cell = row->find(name);
    const auto* value = cell == nullptr ? nullptr : std::get_if<std::int64_t>(cell);
    if (value == nullptr) {
      to.set(name, {});
      return;
    }
    sum += *value;
  }
  to.set(name, rows.empty() ? Cell() : Cell(sum));
}

// A mean over pixels that stands in one row of each line.
void set_pooled(Row& to, std::string_view name, const Case& c) {
  const std::vector<const Row*> rows = last_rows(c, name);
  if (!c.family) return to.set(name, rows.empty() ? Cell() : *rows.back()->find(name));
  if (static_cast<std::int64_t>(rows.size()) < line_count(c)) return to.set(name, {});
  double sum = 0, pixels = 0;
  for (const Row* row : rows) {
    sum += pixels_of(*row, "active") * row->number(name);
    pixels += pixels_of(*row, "active");
  }
  set_finite(to, name, sum / pixels);
}

double mean_bias(const Case& c) {
  double sum = 0, pixels = 0;
  for (const Row* row : c.rows) {
    const double n = c.family ? pixels_of(*row, "active") : 1;
    sum += n * row->number("bias_active");
    pixels += n;
  }
  return sum / pixels;
}

void copy_cell(const Row& from, std::string_view name, Row& to, std::string_view new_name) {
  const Cell* cell = from.find(name);
  to.set(new_name, cell == nullptr ? Cell() : *cell);
}

// The key of a case or a series.
template <std::size_t n>
void copy_key(const Case& c, const std::string_view (&names)[n], Row& to) {
  for (const std::string_view name : names) copy_cell(*c.rows.front(), name, to, name);
  if (c.family) to.set("scene", std::string(scene_family(c.rows.front()->text("scene"))));
}

// The ratio of hit_pixels.h; a cluster is a trial, or a line with all its trials.
void set_edge_ratio(Row& to, const Case& c) {
  std::vector<double> errors, discrepancies;
  std::int64_t last = -1;
  for (const Row* row : c.rows) {
    const double pixels = row->number("hit_pixels");
    if (!(pixels > 0)) continue;
    const std::int64_t line = place_of(*row).first;
    if (!c.family || line != last) {
      errors.push_back(0);
      discrepancies.push_back(0);
    }
    last = line;
    errors.back() += pixels * row->number("hit_mse");
    discrepancies.back() += pixels * row->number("hit_edge_l2_sq");
  }
  const Ratio ratio = ratio_of_sums(errors, discrepancies);
  set_finite(to, "edge_ratio", ratio.value);
  set_interval(to, "edge_ratio", ratio.interval);
}

// The columns of optional_measures.h, where the rows have them.
void set_optional(Row& row, const Case& c) {
  const auto has = [&](const std::string& name) { return c.rows.front()->find(name) != nullptr; };
  for (const std::string region : {"coverage_active", "coverage_all", "filter_active", "filter_all"}) {
    if (!has("rmse_" + region)) continue;
    const Errors errors = errors_of(c, region);
    set_finite(row, "rmse_" + region, rms_over_trials(errors.mse, errors.weights));
    if (region.starts_with("coverage")) set_interval(row, "rmse_" + region, rms_interval(errors.mse, errors.weights));
  }
  for (const std::string name : {"flat_field_rms", "ringing_rms_got", "ringing_rms_exact"}) {
    if (!has(name)) continue;
    std::vector<double> squares;
    for (const Row* x : c.rows) squares.push_back(x->number(name) * x->number(name));
    set_finite(row, name, rms_over_trials(squares));
  }
  for (const DiscrepancyInfo& info : discrepancies()) {
    for (const bool with_time : {false, true}) {
      const std::string name = discrepancy_column(info, with_time);
      if (!has(name)) continue;
      // The same in all rows of a case.
      for (const std::string& cell : {name, name + "_error"}) copy_cell(*c.rows.front(), cell, row, cell);
    }
  }
  if (has("hit_pixels")) set_edge_ratio(row, c);
  if (!c.family && c.rows.back()->find("spectrum_window") != nullptr) {
    for (const std::string_view name : kSpectrumColumns) copy_cell(*c.rows.back(), name, row, name);
  }
  for (const std::string name : {"overshoot_got", "overshoot_exact", "undershoot_got", "undershoot_exact"}) {
    if (has(name)) set_finite(row, name, largest_of(c, name));
  }
}

Row summary_row(const Case& c) {
  constexpr std::string_view kKey[] = {"scene", "pattern", "spp", "filter", "estimator", "layout"};
  Row row;
  copy_key(c, kKey, row);
  row.set("n_trials", trial_count(c));
  for (const std::string region : {"active", "all"}) {
    const Errors errors = errors_of(c, region);
    const auto interval = rms_interval(errors.mse, errors.weights);
    set_finite(row, "rmse_" + region, rms_over_trials(errors.mse, errors.weights));
    set_interval(row, "rmse_" + region, interval);
    if (region == "active") row.set("ci_method", interval ? method(kRmsMethod, c.family) : Cell());
  }
  set_finite(row, "max_abs_active", largest_of(c, "max_abs_active"));
  set_finite(row, "bias_active", mean_bias(c));
  for (const std::string_view name : {"bias_sq_active", "variance_active"}) set_pooled(row, name, c);
  for (const std::string_view name : {"pixels_total", "pixels_active"}) set_sum(row, name, last_rows(c, name));
  for (const std::string_view name : {"samples_total", "samples_evaluated", "fallbacks"}) set_sum(row, name, c.rows);
  set_finite(row, "error_bound", largest_of(c, "error_bound"));
  row.set("reference_limited", is_limited(c));
  row.set("n_scenes", line_count(c));
  set_optional(row, c);
  return row;
}

// The rate of one series; an empty row when there is none. The points are the cases in rising spp.
Row slope_row(const Series& series, const std::vector<Case>& cases) {
  std::vector<const Case*> sorted;
  for (const std::size_t i : series.cases) sorted.push_back(&cases[i]);
  std::stable_sort(sorted.begin(), sorted.end(), [](const Case* a, const Case* b) { return a->spp < b->spp; });
  // Points need the same lines and trials: those of the first case with the most of them.
  const Case* fullest = sorted.front();
  for (const Case* c : sorted) {
    if (c->rows.size() > fullest->rows.size()) fullest = c;
  }

  std::string left_out;
  std::vector<SlopePoint> points;
  for (const Case* c : sorted) {
    const Errors errors = errors_of(*c, "active");
    const char* reason = is_limited(*c)                         ? "reference limited"
                         : !(c->spp > 0)                        ? "no sample count"
                         : places_of(*c) != places_of(*fullest) ? (c->family ? "other lines or trials" : "other trials")
                         : !(rms_over_trials(errors.mse) > 0)   ? "no error"
                                                                : nullptr;
    if (reason != nullptr) {
      left_out += (left_out.empty() ? "" : ", ") + shortest(c->spp) + " (" + reason + ")";
      continue;
    }
    // The same lines have the same pixels at every count: whatever lines a resample draws, their pixels scale all of
    // its points alike and cannot tilt its slope. So sums over pixels serve as well as means.
    SlopePoint point{c->spp, errors.mse};
    for (std::size_t i = 0; i < errors.weights.size(); ++i) point.mse[i] *= errors.weights[i];
    points.push_back(std::move(point));
  }
  const std::optional<Slope> slope = fit_slope(points);
  Row row;
  if (!slope) return row;
  copy_key(*fullest, kSeriesKey, row);
  row.set("slope", slope->slope);
  set_interval(row, "slope", slope->interval);
  row.set("ci_method", slope->interval ? method(kSlopeMethod, fullest->family) : Cell());
  row.set("n_trials", trial_count(*fullest));
  row.set("spp_min", static_cast<std::int64_t>(slope->n_min));
  row.set("spp_max", static_cast<std::int64_t>(slope->n_max));
  row.set("n_spp", static_cast<std::int64_t>(slope->points));
  row.set("left_out", left_out.empty() ? Cell() : Cell(left_out));
  row.set("n_scenes", line_count(*fullest));
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
      cases.push_back({{}, s->second, spp, scene_family(row.text("scene")) != row.text("scene")});
      all_series[s->second].cases.push_back(c->second);
    }
    cases[c->second].rows.push_back(&row);
  }
  // Lines and trials pair up across sample counts by their place, so their order must be that of their numbers.
  for (Case& c : cases) {
    std::stable_sort(c.rows.begin(), c.rows.end(),
                     [](const Row* a, const Row* b) { return place_of(*a) < place_of(*b); });
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
  summary.filters = rank_filters(rows);
  summary.noise = rank_noise(summary.rows);
  summary.correlations = correlate_discrepancies(summary.rows);
  return summary;
}

}  // namespace moire
