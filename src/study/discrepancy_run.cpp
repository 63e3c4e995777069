// Running a study of discrepancies.
#include "study/discrepancy_run.h"

#include <algorithm>
#include <cassert>
#include <string>
#include <utility>
#include <vector>

#include "core/parallel.h"
#include "study/stopwatch.h"

namespace moire {
namespace {

// One set and its rows, one per measure.
struct Trial {
  std::vector<double> x, y, t;
  Table rows;
  PointView view() const { return {x, y, t}; }
};

Trial run_trial(const DiscrepancyStudy& study, const DiscrepancyGroup& group, std::uint32_t trial) {
  const DiscrepancyBlock& block = study.blocks[group.block];
  const PatternChoice& pattern = block.patterns[group.pattern];
  const int n = block.n[group.n], dims = block.dims[group.dims];
  Trial out;
  out.x.resize(static_cast<std::size_t>(n));
  out.y.resize(out.x.size());
  out.t.resize(dims == 3 ? out.x.size() : 0);
  const Stopwatch making;
  Pattern(pattern, n, Draw{study.seed, trial}).fill_set({out.x, out.y, out.t});
  const std::int64_t points_ns = making.nanoseconds();
  const Key key = pixel_key(draw_hash(study.seed, trial), {});
  for (const DiscrepancyChoice& measure : block.measures) {
    const Stopwatch measuring;
    const Discrepancy value = measure(out.view(), key);
    const std::int64_t measure_ns = measuring.nanoseconds();
    Row row;
    row.set("pattern", pattern.text());
    row.set("n", std::int64_t{n});
    row.set("dims", std::int64_t{dims});
    row.set("measure", measure.text());
    row.set("method", std::string(measure.method()));
    row.set("trial", std::int64_t{trial});
    row.set("seed", static_cast<std::int64_t>(study.seed));
    row.set("discrepancy", finite_cell(value.value));
    row.set("discrepancy_error", measure.is_monte_carlo() ? finite_cell(value.error) : Cell());
    row.set("time_points_ns", points_ns);
    row.set("time_measure_ns", measure_ns);
    row.set("time_threads", std::int64_t{thread_count()});
    row.set("status", std::string("ok"));
    out.rows.push_back(std::move(row));
  }
  return out;
}

}  // namespace

Results run(const DiscrepancyStudy& study, const DiscrepancyPlan& plan, const DiscrepancyObserver& observer,
            Table earlier) {
  assert(earlier.empty() || earlier.size() == plan.rows);
  Table rows = std::move(earlier);
  rows.resize(plan.rows);
  const auto is_due = [&](std::size_t i) { return rows[i].cells().empty(); };
  std::size_t due = 0, done = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) due += is_due(i);

  bool complete = true;
  // Trials at a time: enough for all threads, few enough to stop soon.
  const auto together = static_cast<std::uint32_t>(std::max(1, 2 * thread_count()));
  for (const DiscrepancyGroup& group : plan.groups) {
    const std::size_t measures = study.blocks[group.block].measures.size();
    const auto row_of = [&](std::size_t measure, std::uint32_t trial) {
      return group.first_row + measure * group.trials + trial;
    };
    std::vector<std::uint32_t> trials;
    for (std::uint32_t trial = 0; trial < group.trials; ++trial) {
      bool any = trial == 0 && observer.first_set != nullptr && study.images;
      for (std::size_t m = 0; m < measures; ++m) any |= is_due(row_of(m, trial));
      if (any) trials.push_back(trial);
    }
    for (std::size_t begin = 0; begin < trials.size() && complete; begin += together) {
      if (observer.stop && observer.stop()) {
        complete = false;
        break;
      }
      std::vector<Trial> results(std::min<std::size_t>(together, trials.size() - begin));
      parallel_for(results.size(), [&](std::size_t i) { results[i] = run_trial(study, group, trials[begin + i]); });
      for (std::size_t i = 0; i < results.size(); ++i) {
        const std::uint32_t trial = trials[begin + i];
        if (trial == 0 && observer.first_set && study.images) observer.first_set(group, results[i].view());
        for (std::size_t m = 0; m < measures; ++m) {
          Row& row = rows[row_of(m, trial)];
          if (!row.cells().empty()) continue;
          row = std::move(results[i].rows[m]);
          if (observer.row) observer.row(row);
          ++done;
        }
      }
      if (observer.progress && due > 0) observer.progress(done, due);
    }
  }

  Results out;
  out.complete = complete;
  for (Row& row : rows) {
    if (!row.cells().empty()) out.rows.push_back(std::move(row));
  }
  return out;
}

}  // namespace moire
