// What a study says, over trials: one summary row per case, and one convergence rate per series of sample counts.
// Derived from the raw rows alone, so that it can be made again from the files.
#pragma once

#include "study/results.h"

namespace moire {

// Scenes that are random lines of one table (scene_family in scene_file.h) are summarised as one, under the family's
// name: errors are pooled over all pixels that the lines hit, that is, the lines' MSE are weighted by their pixels, so
// that every pixel sees the law of lines itself. The lines are then what is independent: intervals and slopes take
// whole lines, all trials of a line together, and their methods end in "-by-line".
struct Summary {
  // One row per scene, pattern, spp, filter and estimator, in the order of their first raw rows:
  //   n_trials; rmse_active, rmse_active_lo, rmse_active_hi, ci_method; the same for rmse_all (MSE averaged over
  //   trials, then the root; 95%); max_abs_active (over trials); bias_active (mean over trials); bias_sq_active and
  //   variance_active; pixels_total, pixels_active (of one image; of a family, of one image per line); samples_total,
  //   samples_evaluated, fallbacks (sums over trials); error_bound (largest); reference_limited; n_scenes (lines of a
  //   family, else 1); and of the row's series slope, slope_lo, slope_hi, slope_ci_method, slope_spp_min,
  //   slope_spp_max, slope_left_out.
  //   Where the study measured them (optional_measures.h): rmse_coverage_active, rmse_coverage_all, each with _lo and
  //   _hi; rmse_filter_active, rmse_filter_all; flat_field_rms, ringing_rms_got, ringing_rms_exact (roots of mean
  //   squares over trials); overshoot and undershoot, _got and _exact (largest); star_l2, ... and their errors, as in
  //   the rows; edge_ratio with _lo and _hi (over trials, of a family over lines); the columns of noise_measures.h, as
  //   they stand in the last trial's row (of a family: none).
  Table rows;
  // One row per scene, pattern, filter and estimator with a rate: slope of log rmse_active against log spp, slope_lo,
  //   slope_hi, ci_method, n_trials, spp_min, spp_max, n_spp (the points used), left_out (sample counts that are
  //   not used, and why; empty when all are) and n_scenes.
  Table slopes;
  Table filters;       // rank_filters() of the raw rows; empty unless the study measured coverage
  Table noise;         // rank_noise(rows); empty unless the study measured spectrum
  Table correlations;  // correlate_discrepancies(rows); empty unless the study measured discrepancies
};

// Rows without rmse_active, or whose `status` is neither missing nor "ok", count nowhere. bias_sq_active and
// variance_active, which need every pixel of every trial, are taken from the case's last row that has them (of a
// family: their mean by pixels, if every line has them). A case with a reference_limited row (a family: whose pooled
// RMSE is limited; that of one line may be small by chance) is summarised and flagged, but is no point of a slope; nor
// is one with other lines or trials than the most complete case of its series, or with no error at all.
Summary summarize(const Table& rows);

}  // namespace moire
