// Whether a discrepancy of patterns predicts the errors of images.
#include "study/discrepancy_correlation.h"

#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "study/discrepancy_measure.h"

namespace moire {
namespace {

struct Point {
  double count, discrepancy, error;  // samples, log T, log rmse
};

struct Moments {
  double xx = 0, xy = 0, yy = 0;
  double correlation() const { return xy / std::sqrt(xx * yy); }
};

// About the means, of all points or of each count's.
Moments moments(const std::vector<Point>& points, bool by_count) {
  struct Mean {
    double n = 0, x = 0, y = 0;
  };
  std::map<double, Mean> means;
  for (const Point& p : points) {
    Mean& mean = means[by_count ? p.count : 0];
    mean.n += 1;
    mean.x += p.discrepancy;
    mean.y += p.error;
  }
  Moments sum;
  for (const Point& p : points) {
    const Mean& mean = means[by_count ? p.count : 0];
    const double x = p.discrepancy - mean.x / mean.n, y = p.error - mean.y / mean.n;
    sum.xx += x * x;
    sum.xy += x * y;
    sum.yy += y * y;
  }
  return sum;
}

}  // namespace

Table correlate_discrepancies(const Table& summary) {
  constexpr std::string_view kKey[] = {"scene", "filter", "estimator", "layout"};
  Table table;
  std::vector<std::vector<std::string>> keys;
  std::map<std::vector<std::string>, std::vector<const Row*>> groups;
  for (const Row& row : summary) {
    std::vector<std::string> key;
    for (const std::string_view name : kKey) key.emplace_back(row.text(name));
    if (groups[key].empty()) keys.push_back(key);
    groups[key].push_back(&row);
  }
  for (const auto& key : keys) {
    for (const DiscrepancyInfo& info : discrepancies()) {
      for (const bool with_time : {false, true}) {
        const std::string column = discrepancy_column(info, with_time);
        std::vector<Point> points;
        for (const Row* row : groups[key]) {
          const double x = std::log(row->number(column)), y = std::log(row->number("rmse_active"));
          if (std::isfinite(x) && std::isfinite(y) && !row->flag("reference_limited")) {
            points.push_back({row->number("spp"), x, y});
          }
        }
        if (points.size() < 3) continue;
        const Moments all = moments(points, false), within = moments(points, true);
        Row row;
        for (std::size_t i = 0; i < std::size(kKey); ++i) row.set(kKey[i], key[i]);
        row.set("discrepancy", column);
        row.set("points", static_cast<std::int64_t>(points.size()));
        row.set("correlation", finite_cell(all.correlation()));
        row.set("same_n_correlation", finite_cell(within.correlation()));
        row.set("slope", finite_cell(all.xy / all.xx));
        table.push_back(std::move(row));
      }
    }
  }
  return table;
}

}  // namespace moire
