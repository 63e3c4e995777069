// Filters ranked over the scenes of a study.
#include "study/filter_ranking.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "study/columns.h"

namespace moire {
namespace {

constexpr const char* kErrors[] = {"rmse_all", "rmse_coverage_all"};

// The rows of one pattern and sample count.
using Field = std::vector<const Row*>;

// Sum over scenes of the log of an error over the scene's best.
struct Standing {
  const Row* first = nullptr;
  std::size_t scenes = 0;
  double log_ratio[2] = {0, 0};
};

std::vector<Standing> standings(const Field& field) {
  std::map<std::string_view, double> best[2];  // by scene
  for (const Row* row : field) {
    for (std::size_t i = 0; i < 2; ++i) {
      const auto known = best[i].try_emplace(row->text("scene"), row->number(kErrors[i])).first;
      known->second = std::fmin(known->second, row->number(kErrors[i]));
    }
  }
  std::vector<Standing> all;
  std::map<std::pair<std::string_view, std::string_view>, std::size_t> index;
  for (const Row* row : field) {
    const std::string_view scene = row->text("scene");
    if (!(best[0].at(scene) > 0) || !(best[1].at(scene) > 0)) continue;
    const auto [known, is_new] = index.try_emplace({row->text("filter"), row->text("estimator")}, all.size());
    if (is_new) all.push_back({.first = row});
    Standing& s = all[known->second];
    ++s.scenes;
    for (std::size_t i = 0; i < 2; ++i) s.log_ratio[i] += std::log(row->number(kErrors[i]) / best[i].at(scene));
  }
  std::size_t most = 0;
  for (const Standing& s : all) most = std::max(most, s.scenes);
  all.erase(std::remove_if(all.begin(), all.end(), [&](const Standing& s) { return s.scenes < most; }), all.end());
  return all;
}

// 1 + the number of better ones: equal ones share a rank.
std::int64_t rank_of(const std::vector<Standing>& all, const Standing& s, std::size_t i) {
  return 1 + std::count_if(all.begin(), all.end(),
                           [&](const Standing& other) { return other.log_ratio[i] < s.log_ratio[i]; });
}

}  // namespace

Table rank_filters(const Table& summary_rows) {
  std::vector<Field> fields;
  std::map<std::pair<std::string, double>, std::size_t> index;
  for (const Row& row : summary_rows) {
    if (!std::isfinite(row.number("rmse_coverage_all")) || !std::isfinite(row.number("rmse_all"))) continue;
    const auto [known, is_new] = index.try_emplace({sampler_of(row), row.number("spp")}, fields.size());
    if (is_new) fields.emplace_back();
    fields[known->second].push_back(&row);
  }
  Table ranking;
  for (const Field& field : fields) {
    std::vector<Standing> all = standings(field);
    std::stable_sort(all.begin(), all.end(),
                     [](const Standing& a, const Standing& b) { return a.log_ratio[1] < b.log_ratio[1]; });
    for (const Standing& s : all) {
      const auto scenes = static_cast<double>(s.scenes);
      Row row;
      for (const char* key : {"pattern", "spp", "filter", "estimator", "layout"}) {
        if (const Cell* cell = s.first->find(key)) row.set(key, *cell);
      }
      row.set("n_scenes", static_cast<std::int64_t>(s.scenes));
      row.set("relative_sampling", std::exp(s.log_ratio[0] / scenes));
      row.set("rank_sampling", rank_of(all, s, 0));
      row.set("relative_total", std::exp(s.log_ratio[1] / scenes));
      row.set("rank_total", rank_of(all, s, 1));
      ranking.push_back(std::move(row));
    }
  }
  return ranking;
}

}  // namespace moire
