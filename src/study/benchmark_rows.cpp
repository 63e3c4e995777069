// From timings to the tables of a benchmark.
#include "study/benchmark_rows.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <map>
#include <utility>

#include "measure/pareto_front.h"
#include "measure/power_law.h"
#include "measure/timings.h"

namespace moire {
namespace {

constexpr double kSecond = 1e9;  // nanoseconds

// "time_render_ns" and "least" to "time_render_least_ns".
std::string with_suffix(const std::string& name, const std::string& suffix) {
  if (!name.ends_with("_ns")) return name + "_" + suffix;
  return name.substr(0, name.size() - 3) + "_" + suffix + "_ns";
}

void set_spread(Row& row, const std::string& name, std::span<const double> values) {
  const TimingSpread spread = timing_spread(values);
  row.set(name, finite_cell(spread.median));
  row.set(with_suffix(name, "deviation"), finite_cell(spread.deviation));
  row.set(with_suffix(name, "least"), finite_cell(spread.least));
  row.set(with_suffix(name, "most"), finite_cell(spread.most));
}

// The texts of the cells.
std::vector<std::string> key_of(const Row& row, std::span<const std::string_view> names) {
  std::vector<std::string> key;
  for (const std::string_view name : names) key.emplace_back(row.text(name));
  return key;
}

// Rows with the same key, in order of first appearance.
std::vector<std::vector<Row*>> groups_of(Table& rows, std::span<const std::string_view> names) {
  std::vector<std::vector<Row*>> groups;
  std::map<std::vector<std::string>, std::size_t> index;
  for (Row& row : rows) {
    const auto [at, is_new] = index.try_emplace(key_of(row, names), groups.size());
    if (is_new) groups.emplace_back();
    groups[at->second].push_back(&row);
  }
  return groups;
}

}  // namespace

void set_timings(Row& row, const std::string& name, std::span<const double> timings, double per) {
  std::vector<double> each;
  if (per > 0) {
    for (const double t : timings) each.push_back(t / per);
  }
  set_spread(row, name, each);
}

void set_ratio(Row& row, const std::string& name, std::span<const double> a, std::span<const double> b) {
  std::vector<double> ratios;
  if (!a.empty() && !b.empty()) {
    assert(a.size() == b.size());
    for (std::size_t i = 0; i < a.size(); ++i) ratios.push_back(a[i] / b[i]);
  }
  set_spread(row, name, ratios);
}

void set_case_times(Row& row, const CaseTimings& timings) {
  const double pixels = row.number("pixels_active"), rmse = row.number("rmse_active");
  set_timings(row, "time_setup_ns", timings.setup);
  set_timings(row, "time_first_use_ns", timings.first_use);
  set_timings(row, "time_reference_ns", timings.reference);
  set_timings(row, "time_generation_pixel_ns", timings.generation, pixels);
  set_timings(row, "time_evaluation_pixel_ns", timings.evaluation, pixels);
  set_timings(row, "time_reconstruction_pixel_ns", timings.reconstruction, pixels);
  set_timings(row, "time_render_pixel_ns", timings.render, pixels);
  set_timings(row, "time_exhaustive_pixel_ns", timings.exhaustive, pixels);
  set_timings(row, "time_exhaustive_sample_ns", timings.exhaustive, row.number("samples_total"));
  set_ratio(row, "time_exhaustive_ratio", timings.exhaustive, timings.render);
  row.set("time_efficiency", finite_cell(kSecond / (rmse * rmse * row.number("time_render_pixel_ns"))));
}

void mark_fronts(Table& rows) {
  constexpr std::string_view kKey[] = {"scene", "filter", "estimator"};
  for (const std::vector<Row*>& group : groups_of(rows, kKey)) {
    std::vector<CostError> points;
    for (const Row* row : group) points.push_back({row->number("time_render_pixel_ns"), row->number("rmse_active")});
    const std::vector<bool> front = pareto_front(points);
    for (std::size_t i = 0; i < group.size(); ++i) group[i]->set("time_front", bool{front[i]});
  }
}

Table fit_exponents(Table& rows) {
  constexpr std::string_view kKey[] = {"scene", "layout", "pattern", "filter", "estimator"};
  Table exponents;
  for (const std::vector<Row*>& series : groups_of(rows, kKey)) {
    std::vector<PowerPoint> points;
    for (const Row* row : series) points.push_back({row->number("spp"), row->number("time_render_pixel_ns")});
    std::sort(points.begin(), points.end(), [](const PowerPoint& a, const PowerPoint& b) { return a.n > b.n; });
    if (points.size() > kExponentCounts) points.resize(kExponentCounts);
    const std::optional<PowerLaw> law = fit_power_law(points);
    Row fitted;
    for (const std::string_view name : kKey) fitted.set(name, std::string(series.front()->text(name)));
    const auto set = [&](const char* name, Cell cell) {
      fitted.set(name, cell);
      for (Row* row : series) row->set(name, cell);
    };
    set("time_exponent", law ? Cell(law->exponent) : Cell());
    set("time_exponent_lo", law && law->interval ? Cell(law->interval->lo) : Cell());
    set("time_exponent_hi", law && law->interval ? Cell(law->interval->hi) : Cell());
    if (!law) continue;
    fitted.set("spp_min", static_cast<std::int64_t>(law->n_min));
    fitted.set("spp_max", static_cast<std::int64_t>(law->n_max));
    fitted.set("n_spp", std::int64_t{law->points});
    exponents.push_back(std::move(fitted));
  }
  return exponents;
}

}  // namespace moire
