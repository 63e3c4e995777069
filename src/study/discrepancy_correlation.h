// Whether a discrepancy of patterns predicts the errors of images: correlations over patterns and sample counts.
#pragma once

#include "study/results.h"

namespace moire {

// From summary rows (summary.h), one row per scene, filter, estimator, layout and discrepancy: points (patterns and
// counts that have both an error and a discrepancy); correlation of log rmse_active with log T; same_n_correlation: of
// the same after the means over patterns at each count are taken off, so that it does not say only that more samples
// are better; slope: of log rmse_active against log T, least squares. At least 3 points. They describe these patterns
// and counts, which are no sample of a population: there are no intervals.
Table correlate_discrepancies(const Table& summary);

}  // namespace moire
