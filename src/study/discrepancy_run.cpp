// Running a study of discrepancies.
#include "study/discrepancy_run.h"

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/parallel.h"
#include "measure/discrepancy/test_lines.h"
#include "study/stopwatch.h"

namespace moire {
namespace {

struct PointArrays {
  std::vector<double> x, y, t;
  PointView view() const { return {x, y, t}; }
};

PointArrays make_set(const DiscrepancyStudy& study, const DiscrepancyGroup& group, std::uint32_t trial) {
  const DiscrepancyBlock& block = study.blocks[group.block];
  const int n = block.n[group.n];
  PointArrays set;
  set.x.resize(static_cast<std::size_t>(n));
  set.y.resize(set.x.size());
  set.t.resize(block.dims[group.dims] == 3 ? set.x.size() : 0);
  Pattern(block.patterns[group.pattern], n, Draw{study.seed, trial}).fill_set({set.x, set.y, set.t});
  return set;
}

// The random lines of a study's trials: those of a trial are the same for all its sets, patterns and counts.
class SharedLines {
 public:
  explicit SharedLines(const DiscrepancyStudy& study) {
    std::int64_t bytes = 0;
    for (const DiscrepancyBlock& block : study.blocks) {
      for (const DiscrepancyChoice& measure : block.measures) {
        if (!measure.test_lines()) continue;
        bytes += block.trials * measure.tests() * kLineBytes;
        if (bytes > kMostBytes) return;
        if (find(measure) == laws_.end()) laws_.push_back({*measure.test_lines(), measure.tests(), {}});
        auto& of_trial = find(measure)->of_trial;
        of_trial.resize(std::max(of_trial.size(), static_cast<std::size_t>(block.trials)));
      }
    }
  }

  // Those of the measure; none where its tests are no lines, or lines that would take too much memory. Not for one
  // trial in two threads at a time.
  std::span<const MeasuredLine> lines(const DiscrepancyChoice& measure, std::uint32_t trial, const Key& key) {
    const auto law = find(measure);
    if (law == laws_.end() || trial >= law->of_trial.size()) return {};
    std::vector<MeasuredLine>& lines = law->of_trial[trial];
    if (lines.empty()) lines = measured_lines(law->law, key, law->tests);
    return lines;
  }

 private:
  static constexpr std::int64_t kLineBytes = sizeof(MeasuredLine), kMostBytes = std::int64_t{64} << 20;
  struct Law {
    LineLaw law;
    std::int64_t tests;
    std::vector<std::vector<MeasuredLine>> of_trial;  // empty: not drawn yet
  };

  std::vector<Law>::iterator find(const DiscrepancyChoice& measure) {
    return std::find_if(laws_.begin(), laws_.end(), [&](const Law& law) {
      return measure.test_lines() == law.law && measure.tests() == law.tests;
    });
  }

  std::vector<Law> laws_;
};

// The rows of one set, by measure: those that are due, up to where the run is stopped; others have no cells.
Table run_trial(const DiscrepancyStudy& study, const DiscrepancyGroup& group, std::uint32_t trial,
                const std::vector<bool>& due, const std::function<bool()>& stop, SharedLines& shared) {
  const DiscrepancyBlock& block = study.blocks[group.block];
  Table rows(block.measures.size());
  if (stop && stop()) return rows;
  const Stopwatch making;
  const PointArrays set = make_set(study, group, trial);
  const std::int64_t points_ns = making.nanoseconds();
  const Key key = pixel_key(draw_hash(study.seed, trial), {});
  for (std::size_t m = 0; m < block.measures.size(); ++m) {
    if (!due[m]) continue;
    if (stop && stop()) return rows;
    const DiscrepancyChoice& measure = block.measures[m];
    const Stopwatch measuring;
    const Discrepancy value = measure(set.view(), key, shared.lines(measure, trial, key));
    const std::int64_t measure_ns = measuring.nanoseconds();
    Row& row = rows[m];
    row.set("pattern", block.patterns[group.pattern].text());
    row.set("n", std::int64_t{block.n[group.n]});
    row.set("dims", std::int64_t{block.dims[group.dims]});
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
  }
  return rows;
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

  SharedLines shared(study);
  // Trials at a time: enough for all threads, few enough that rows are kept soon.
  const auto together = static_cast<std::size_t>(std::max(1, 4 * thread_count()));
  const auto stopped = [&] { return observer.stop && observer.stop(); };
  for (const DiscrepancyGroup& group : plan.groups) {
    if (stopped()) break;
    if (observer.first_set && observer.wants_first_set && observer.wants_first_set(group)) {
      observer.first_set(group, make_set(study, group, 0).view());
    }
    const std::size_t measures = study.blocks[group.block].measures.size();
    const auto row_of = [&](std::size_t measure, std::uint32_t trial) {
      return group.first_row + measure * group.trials + trial;
    };
    std::vector<std::uint32_t> trials;
    std::vector<std::vector<bool>> due_of;  // by measure
    for (std::uint32_t trial = 0; trial < group.trials; ++trial) {
      std::vector<bool> missing(measures);
      for (std::size_t m = 0; m < measures; ++m) missing[m] = is_due(row_of(m, trial));
      if (std::find(missing.begin(), missing.end(), true) == missing.end()) continue;
      trials.push_back(trial);
      due_of.push_back(std::move(missing));
    }
    for (std::size_t begin = 0; begin < trials.size() && !stopped(); begin += together) {
      std::vector<Table> results(std::min(together, trials.size() - begin));
      parallel_for(results.size(), [&](std::size_t i) {
        results[i] = run_trial(study, group, trials[begin + i], due_of[begin + i], observer.stop, shared);
      });
      for (std::size_t i = 0; i < results.size(); ++i) {
        for (std::size_t m = 0; m < measures; ++m) {
          if (results[i][m].cells().empty()) continue;
          Row& row = rows[row_of(m, trials[begin + i])];
          row = std::move(results[i][m]);
          if (observer.row) observer.row(row);
          ++done;
        }
      }
      if (observer.progress && due > 0) observer.progress(done, due);
    }
  }

  Results out;
  out.complete = done == due;
  for (Row& row : rows) {
    if (!row.cells().empty()) out.rows.push_back(std::move(row));
  }
  return out;
}

}  // namespace moire
