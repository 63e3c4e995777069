// Rows of a study of discrepancies to means over trials, beside theory and the paper, and to rates of convergence.
#pragma once

#include "study/discrepancy_mean.h"
#include "study/discrepancy_study.h"
#include "study/results.h"

namespace moire {

struct DiscrepancySummary {
  // One row per pattern, n, dims and measure: the key; method, trials; mean, mean_lo, mean_hi (Student's t), rms,
  // stderr (of the mean); expected_rms where theory knows the mean square, expected_z; paper, paper_is (mean or rms),
  // table, paper_z, paper_doubt where the paper has a value. z: the difference over the standard errors of both. No
  // interval and no z for one trial.
  Table rows;
  // One row per pattern, dims and measure with two sizes or more: slope of log rms against log n, slope_lo, slope_hi
  // (by trials: none for one), n_min, n_max, points; trials: sets of each size that the slope is of, the
  // first ones of all where sizes have different numbers; known, known_is, why: the exponent where it is known.
  Table slopes;
};

// `rows`: all of the plan, in its order.
DiscrepancySummary summarize(const DiscrepancyStudy& study, const DiscrepancyPlan& plan, const Table& rows);

}  // namespace moire
