// Patterns ranked on each scene.
#include "study/pattern_ranking.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <tuple>
#include <vector>

#include "study/cases.h"
#include "study/columns.h"

namespace moire {
namespace {

// NaN for none.
double median(std::vector<double> values) {
  values.erase(std::remove_if(values.begin(), values.end(), [](double v) { return !std::isfinite(v); }), values.end());
  if (values.empty()) return std::nan("");
  std::sort(values.begin(), values.end());
  const std::size_t half = values.size() / 2;
  return values.size() % 2 == 1 ? values[half] : 0.5 * (values[half - 1] + values[half]);
}

struct TimedError {
  double spp, log_time, log_error;
};

// The rows of one scene, filter and estimator, and the line of each of its patterns, counts and times rising.
struct Contest {
  std::vector<std::size_t> rows;
  std::map<std::string, std::vector<TimedError>> lines;
};

// The log of the error that a pattern reaches within a time; NaN where its smallest count takes longer.
double error_at(const std::vector<TimedError>& line, double log_time) {
  // Of counts that take the same time the largest one is meant.
  const auto after = std::find_if(line.begin(), line.end(), [&](const TimedError& p) { return p.log_time > log_time; });
  if (after == line.end()) return line.back().log_error;
  if (after == line.begin()) return std::nan("");
  const auto before = after - 1;
  const double share = (log_time - before->log_time) / (after->log_time - before->log_time);
  return before->log_error + share * (after->log_error - before->log_error);
}

// Whatever disturbs a clock adds time, and more samples do not take less: a time above that of a larger count is cut
// down to it.
void make_rising(std::vector<TimedError>& line) {
  std::sort(line.begin(), line.end(), [](const TimedError& a, const TimedError& b) { return a.spp < b.spp; });
  for (std::size_t i = line.size(); i-- > 1;) line[i - 1].log_time = std::min(line[i - 1].log_time, line[i].log_time);
}

// Half the interval of log rmse_active.
double half_width(const Row& row) {
  const double half = 0.5 * std::log(row.number("rmse_active_hi") / row.number("rmse_active_lo"));
  return std::isfinite(half) ? half : 0;
}

// Sets `name` to each value over the least and `rank` to its place; empty where there is no value, or the least is 0.
void set_relative(const std::vector<Row*>& to, const std::vector<double>& values, const char* name, const char* rank) {
  double least = HUGE_VAL;
  for (const double value : values) least = std::fmin(least, value);
  for (std::size_t i = 0; i < to.size(); ++i) {
    const bool known = std::isfinite(values[i]);
    to[i]->set(name, known ? finite_cell(values[i] / least) : Cell());
    to[i]->set(rank, known ? Cell(std::int64_t{1} +
                                  std::count_if(values.begin(), values.end(), [&](double v) { return v < values[i]; }))
                           : Cell());
  }
}

void set_intervals(const std::vector<Row*>& to, const std::vector<const Row*>& from) {
  const Row* best = *std::min_element(from.begin(), from.end(), [](const Row* a, const Row* b) {
    return a->number("rmse_active") < b->number("rmse_active");
  });
  for (std::size_t i = 0; i < to.size(); ++i) {
    const double half = from[i] == best ? 0 : std::hypot(half_width(*from[i]), half_width(*best));
    const double relative = to[i]->number("relative_rmse");
    const bool known = from[i] == best || half > 0;
    to[i]->set("relative_rmse_lo", known ? finite_cell(relative * std::exp(-half)) : Cell());
    to[i]->set("relative_rmse_hi", known ? finite_cell(relative * std::exp(half)) : Cell());
  }
}

// The median time of the rows of one spp, as its log; NaN where none has any.
double median_time(const Contest& contest, const std::vector<const Row*>& rows) {
  std::vector<double> times;
  for (const Row* row : rows) {
    const auto line = contest.lines.find(sampler_of(*row));
    if (line == contest.lines.end()) continue;
    const auto own = std::find_if(line->second.begin(), line->second.end(),
                                  [&](const TimedError& p) { return p.spp == row->number("spp"); });
    if (own != line->second.end()) times.push_back(own->log_time);
  }
  return median(std::move(times));
}

void rank_count(const Contest& contest, const std::vector<const Row*>& from, const std::vector<Row*>& to) {
  std::vector<double> errors, timed;
  const double time = median_time(contest, from);
  for (const Row* row : from) {
    errors.push_back(row->number("rmse_active"));
    const auto line = contest.lines.find(sampler_of(*row));
    const bool known = line != contest.lines.end() && std::isfinite(time);
    timed.push_back(known ? std::exp(error_at(line->second, time)) : std::nan(""));
  }
  set_relative(to, errors, "relative_rmse", "rank");
  set_intervals(to, from);
  set_relative(to, timed, "relative_at_equal_time", "rank_at_equal_time");
}

}  // namespace

Table with_times(Table summary_rows, const Table& rows) {
  const Cases cases(rows);
  for (Row& row : summary_rows) {
    const Reconstruction kernel{std::string(row.text("filter")), std::string(row.text("estimator"))};
    std::vector<double> times, per_pixel;
    for (const Row* raw : cases.at(std::string(row.text("scene")), sampler_of(row), kernel,
                                   static_cast<std::int64_t>(row.number("spp")))) {
      times.push_back(raw->number("time_render_ns"));
      per_pixel.push_back(times.back() / raw->number("pixels_active"));
    }
    row.set("time_render_ns", finite_cell(median(std::move(times))));
    row.set("time_per_active_pixel_ns", finite_cell(median(std::move(per_pixel))));
  }
  return summary_rows;
}

Table rank_patterns(const Table& timed_rows) {
  std::map<std::tuple<std::string, std::string, std::string>, Contest> contests;
  Table ranking;
  std::vector<const Row*> source;
  for (const Row& row : timed_rows) {
    if (!std::isfinite(row.number("rmse_active"))) continue;
    Contest& contest =
        contests[{std::string(row.text("scene")), std::string(row.text("filter")), std::string(row.text("estimator"))}];
    contest.rows.push_back(ranking.size());
    const TimedError point{row.number("spp"), std::log(row.number("time_render_ns")),
                           std::log(row.number("rmse_active"))};
    if (std::isfinite(point.log_time) && std::isfinite(point.log_error)) {
      contest.lines[sampler_of(row)].push_back(point);
    }
    ranking.emplace_back();
    for (const char* key : {"scene", "filter", "estimator", "pattern", "layout", "spp"}) {
      if (const Cell* cell = row.find(key)) ranking.back().set(key, *cell);
    }
    source.push_back(&row);
  }
  for (auto& [unused, contest] : contests) {
    for (auto& [also_unused, line] : contest.lines) make_rising(line);
    std::map<double, std::vector<std::size_t>> by_spp;
    for (const std::size_t i : contest.rows) by_spp[source[i]->number("spp")].push_back(i);
    for (const auto& [spp, indices] : by_spp) {
      std::vector<const Row*> from;
      std::vector<Row*> to;
      for (const std::size_t i : indices) {
        from.push_back(source[i]);
        to.push_back(&ranking[i]);
      }
      rank_count(contest, from, to);
    }
  }
  return ranking;
}

}  // namespace moire
