// Patterns ranked by the size of their errors and by what they look like.
#include "study/noise_ranking.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "study/columns.h"

namespace moire {
namespace {

// The rows that compete: those of one filter, estimator and count.
using Field = std::vector<const Row*>;

double mean_of(const std::vector<const Row*>& rows, std::string_view name) {
  double sum = 0;
  for (const Row* row : rows) sum += row->number(name);
  return sum / static_cast<double>(rows.size());
}

// The mean over the scenes, 0 where it is within two standard errors of it.
double mean_or_chance(const std::vector<const Row*>& rows, std::string_view name, std::string_view error) {
  const double mean = mean_of(rows, name);
  return std::fabs(mean) <= 2 * mean_of(rows, error) ? 0 : mean;
}

// What is ranked by its ratio to the best: an error, or the root of a power.
struct Amplitude {
  std::string_view column;
  bool is_power;
  // `end`: "", or "_lo" or "_hi" for the ends of its interval.
  double of(const Row& row, std::string_view end = "") const {
    const double value = row.number(std::string(column) + std::string(end));
    return is_power ? std::sqrt(value) : value;
  }
};
constexpr Amplitude kRmse{"rmse_all", false}, kCsf{"csf_rms", false}, kLowFrequency{"low_frequency_noise", true};

// Geometric mean over the scenes of an amplitude, or an end of its interval, over the smallest of its scene. Scenes on
// which somebody has none at all say nothing of ratios.
double relative(const std::vector<const Row*>& rows, const Amplitude& amplitude, const Field& field,
                std::string_view end = "") {
  double sum = 0, count = 0;
  for (const Row* row : rows) {
    double least = std::nan("");
    for (const Row* other : field) {
      if (other->text("scene") == row->text("scene")) least = std::fmin(least, amplitude.of(*other));
    }
    if (!(least > 0)) continue;
    sum += std::log(amplitude.of(*row, end) / least);
    count += 1;
  }
  return std::exp(sum / count);
}

std::size_t scenes_of(const Field& field) {
  std::set<std::string_view> scenes;
  for (const Row* row : field) scenes.insert(row->text("scene"));
  return scenes.size();
}

Row standing(const std::vector<const Row*>& rows, const Field& field) {
  Row out;
  for (const char* key : {"filter", "estimator", "spp", "pattern", "layout"}) {
    if (const Cell* cell = rows.front()->find(key)) out.set(key, *cell);
  }
  std::int64_t peaks = 0;
  double highest = std::nan("");
  for (const Row* row : rows) {
    if (!row->flag("peak_significant")) continue;
    ++peaks;
    highest = std::fmax(highest, row->number("peak_height_db"));
  }
  out.set("n_scenes", static_cast<std::int64_t>(rows.size()));
  for (const std::string end : {"", "_lo", "_hi"})
    out.set("relative_rmse" + end, finite_cell(relative(rows, kRmse, field, end)));
  out.set("relative_csf", finite_cell(relative(rows, kCsf, field)));
  for (const std::string end : {"", "_lo", "_hi"})
    out.set("relative_low_frequency" + end, finite_cell(relative(rows, kLowFrequency, field, end)));
  for (const std::string end : {"", "_lo", "_hi"})
    out.set("low_frequency_ratio" + end, finite_cell(mean_of(rows, "low_frequency_ratio" + end)));
  const double fraction = mean_of(rows, "structured_fraction");
  const double two_errors = 2 * mean_of(rows, "structured_fraction_error");
  const bool varies = two_errors > 0;
  out.set("structured_fraction", finite_cell(fraction));
  out.set("structured_fraction_lo", varies ? finite_cell(fraction - two_errors) : Cell());
  out.set("structured_fraction_hi", varies ? finite_cell(fraction + two_errors) : Cell());
  out.set("structured_beyond_chance",
          finite_cell(mean_or_chance(rows, "structured_fraction", "structured_fraction_chance")));
  out.set("peaks", peaks);
  out.set("highest_peak_db", finite_cell(highest));
  return out;
}

void set_ranks(Table& rows, std::string_view value, std::string_view rank) {
  for (Row& row : rows) {
    const double mine = row.number(value);
    if (!std::isfinite(mine)) {
      row.set(rank, {});
      continue;
    }
    row.set(rank, std::int64_t{1} + std::count_if(rows.begin(), rows.end(),
                                                  [&](const Row& other) { return other.number(value) < mine; }));
  }
}

}  // namespace

Table rank_noise(const Table& summary_rows) {
  std::vector<Field> fields;
  std::map<std::tuple<std::string_view, std::string_view, double>, std::size_t> index;
  for (const Row& row : summary_rows) {
    if (!std::isfinite(row.number("csf_rms")) || !std::isfinite(row.number("rmse_all"))) continue;
    const std::tuple key(row.text("filter"), row.text("estimator"), row.number("spp"));
    const auto [known, is_new] = index.try_emplace(key, fields.size());
    if (is_new) fields.emplace_back();
    fields[known->second].push_back(&row);
  }
  Table ranking;
  for (const Field& field : fields) {
    std::vector<std::pair<std::string, std::vector<const Row*>>> samplers;
    for (const Row* row : field) {
      const std::string name = sampler_of(*row);
      auto known = std::find_if(samplers.begin(), samplers.end(), [&](const auto& s) { return s.first == name; });
      if (known == samplers.end()) known = samplers.insert(samplers.end(), {name, {}});
      known->second.push_back(row);
    }
    Table standings;
    for (const auto& [name, rows] : samplers) {
      if (rows.size() == scenes_of(field)) standings.push_back(standing(rows, field));
    }
    set_ranks(standings, "relative_rmse", "rank_rmse");
    set_ranks(standings, "relative_csf", "rank_csf");
    set_ranks(standings, "relative_low_frequency", "rank_low_frequency");
    set_ranks(standings, "low_frequency_ratio", "rank_colour");
    set_ranks(standings, "structured_beyond_chance", "rank_structured");
    std::stable_sort(standings.begin(), standings.end(),
                     [](const Row& a, const Row& b) { return a.number("rank_rmse") < b.number("rank_rmse"); });
    ranking.insert(ranking.end(), standings.begin(), standings.end());
  }
  return ranking;
}

}  // namespace moire
