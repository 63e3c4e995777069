// Running a study of discrepancies: from a plan to rows of results.
#pragma once

#include <cstddef>
#include <functional>

#include "measure/discrepancy/point_view.h"
#include "study/discrepancy_study.h"
#include "study/results.h"
#include "study/run.h"

namespace moire {

// What a run tells and asks; every function may be empty. All but `stop` are called from the thread that runs the
// study, `stop` from several at once.
struct DiscrepancyObserver {
  std::function<void(const Row&)> row;  // as they are finished; not for rows that were there
  // The set of trial 0 of a group that wants it.
  std::function<bool(const DiscrepancyGroup&)> wants_first_set;
  std::function<void(const DiscrepancyGroup&, const PointView&)> first_set;
  std::function<void(std::size_t done, std::size_t due)> progress;  // rows
  std::function<bool()> stop;  // asked before each measure of a set; true ends the run, and what is finished is kept
};

// Runs the plan, trials in parallel; the rows do not depend on the number of threads, time_* apart. `earlier` are rows
// of the same study from a run that was stopped, one per row of the plan, without cells where there is none; or none at
// all. They are kept as they are.
//
// Columns: the key (pattern, n, dims, measure, trial), method, seed; discrepancy: T_N, or D_N for a measure whose
// method is exact; discrepancy_error,
// the standard error that random tests leave; time_points_ns, time_measure_ns, time_threads; status.
Results run(const DiscrepancyStudy& study, const DiscrepancyPlan& plan, const DiscrepancyObserver& observer,
            Table earlier = {});

}  // namespace moire
