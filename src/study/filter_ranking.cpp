// Filters ranked over the scenes of a study.
#include "study/filter_ranking.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "measure/statistics.h"
#include "study/columns.h"

namespace moire {
namespace {

constexpr const char* kErrors[] = {"rmse_all", "rmse_coverage_all"};
constexpr const char* kNames[] = {"sampling", "total"};

// Trial and scene.
using Place = std::pair<double, std::string_view>;

// One filter and estimator among those of a pattern and count: its rows by place.
struct Contender {
  const Row* first = nullptr;
  std::map<Place, const Row*> rows;
};

// Mean over the places of the log of an error.
double mean_log(const Contender& c, const std::set<Place>& places, const char* error) {
  double sum = 0;
  for (const Place& place : places) sum += std::log(c.rows.at(place)->number(error));
  return sum / static_cast<double>(places.size());
}

// Half the 95% interval of the mean over trials of log c - log best; none for fewer than 2 trials.
std::optional<double> half_interval(const Contender& c, const Contender& best, const std::set<Place>& places,
                                    const char* error) {
  std::map<double, std::pair<double, double>> by_trial;  // sum over scenes, scenes
  for (const Place& place : places) {
    auto& [sum, count] = by_trial[place.first];
    sum += std::log(c.rows.at(place)->number(error)) - std::log(best.rows.at(place)->number(error));
    count += 1;
  }
  const auto trials = static_cast<double>(by_trial.size());
  if (trials < 2) return std::nullopt;
  double mean = 0, squares = 0;
  for (const auto& [unused, x] : by_trial) mean += x.first / x.second / trials;
  for (const auto& [unused, x] : by_trial) squares += (x.first / x.second - mean) * (x.first / x.second - mean);
  return student_t95(static_cast<std::int64_t>(trials) - 1) * std::sqrt(squares / (trials - 1) / trials);
}

// The contenders that have all places.
std::vector<Contender> complete(const std::vector<const Row*>& field) {
  std::vector<Contender> all;
  std::map<std::pair<std::string_view, std::string_view>, std::size_t> index;
  std::size_t most = 0;
  for (const Row* row : field) {
    const auto [known, is_new] = index.try_emplace({row->text("filter"), row->text("estimator")}, all.size());
    if (is_new) all.push_back({row, {}});
    Contender& c = all[known->second];
    c.rows.emplace(Place(row->number("trial"), row->text("scene")), row);
    most = std::max(most, c.rows.size());
  }
  all.erase(std::remove_if(all.begin(), all.end(), [&](const Contender& c) { return c.rows.size() < most; }),
            all.end());
  return all;
}

// Those where every contender has an error.
std::set<Place> useful_places(const std::vector<Contender>& all) {
  std::set<Place> places;
  for (const auto& [place, unused] : all.front().rows) {
    const bool useful = std::all_of(all.begin(), all.end(), [&, at = place](const Contender& c) {
      const auto row = c.rows.find(at);
      return row != c.rows.end() && row->second->number(kErrors[0]) > 0 && row->second->number(kErrors[1]) > 0;
    });
    if (useful) places.insert(place);
  }
  return places;
}

void rank(const std::vector<const Row*>& field, Table& ranking) {
  const std::vector<Contender> all = complete(field);
  const std::set<Place> places = useful_places(all);
  if (places.empty()) return;
  Table rows(all.size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    for (const char* key : {"pattern", "spp", "filter", "estimator", "layout"}) {
      if (const Cell* cell = all[i].first->find(key)) rows[i].set(key, *cell);
    }
  }
  for (std::size_t e = 0; e < std::size(kErrors); ++e) {
    const std::string name = kNames[e];
    std::vector<double> logs;
    for (const Contender& c : all) logs.push_back(mean_log(c, places, kErrors[e]));
    const auto best = static_cast<std::size_t>(std::min_element(logs.begin(), logs.end()) - logs.begin());
    for (std::size_t i = 0; i < all.size(); ++i) {
      const double log_ratio = logs[i] - logs[best];
      const auto half = half_interval(all[i], all[best], places, kErrors[e]);
      rows[i].set("relative_" + name, std::exp(log_ratio));
      rows[i].set("relative_" + name + "_lo", half ? Cell(std::exp(log_ratio - *half)) : Cell());
      rows[i].set("relative_" + name + "_hi", half ? Cell(std::exp(log_ratio + *half)) : Cell());
      rows[i].set("rank_" + name,
                  std::int64_t{1} + std::count_if(logs.begin(), logs.end(), [&](double l) { return l < logs[i]; }));
    }
  }
  std::stable_sort(rows.begin(), rows.end(),
                   [](const Row& a, const Row& b) { return a.number("rank_total") < b.number("rank_total"); });
  ranking.insert(ranking.end(), rows.begin(), rows.end());
}

}  // namespace

Table rank_filters(const Table& rows) {
  std::vector<std::vector<const Row*>> fields;
  std::map<std::pair<std::string, double>, std::size_t> index;
  for (const Row& row : rows) {
    if (!std::isfinite(row.number(kErrors[0])) || !std::isfinite(row.number(kErrors[1]))) continue;
    const auto [known, is_new] = index.try_emplace({sampler_of(row), row.number("spp")}, fields.size());
    if (is_new) fields.emplace_back();
    fields[known->second].push_back(&row);
  }
  Table ranking;
  for (const auto& field : fields) rank(field, ranking);
  return ranking;
}

}  // namespace moire
