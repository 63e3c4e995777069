// What a study says, over trials: one summary row per case, and one convergence rate per series of sample counts.
// Derived from the raw rows alone, so that it can be made again from the files.
#pragma once

#include "study/results.h"

namespace moire {

struct Summary {
  // One row per scene, pattern, spp, filter and estimator, in the order of their first raw rows:
  //   n_trials; rmse_active, rmse_active_lo, rmse_active_hi, ci_method; the same for rmse_all (MSE averaged over
  //   trials, then the root; 95%); max_abs_active (over trials); bias_active (mean over trials); bias_sq_active and
  //   variance_active; pixels_total, pixels_active (of one image); samples_total, samples_evaluated, fallbacks (sums
  //   over trials); error_bound (largest); reference_limited; and of the row's series slope, slope_lo, slope_hi,
  //   slope_ci_method, slope_spp_min, slope_spp_max, slope_left_out.
  Table rows;
  // One row per scene, pattern, filter and estimator with a rate: slope of log rmse_active against log spp, slope_lo,
  //   slope_hi, ci_method, n_trials, spp_min, spp_max, n_spp (the points used) and left_out (sample counts that are
  //   not used, and why; empty when all are).
  Table slopes;
};

// Rows without rmse_active, or whose `status` is neither missing nor "ok", count nowhere. bias_sq_active and
// variance_active, which need every pixel of every trial, are taken from the case's last row that has them. A case with
// a reference_limited row is summarised and flagged, but is no point of a slope; nor is one with other trials than the
// most complete case of its series, or with no error at all.
Summary summarize(const Table& rows);

}  // namespace moire
