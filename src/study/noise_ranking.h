// Patterns ranked over the scenes of a study by how large their errors are and by what they look like, so that one sees
// where the rankings part.
#pragma once

#include "study/results.h"

namespace moire {

// `summary_rows` are those of summarize(). Rows without the columns of the measure `spectrum` give none.
//
// One row per filter, estimator, spp, pattern and layout that has all scenes that any of them has: relative_rmse,
// relative_csf and relative_low_frequency, geometric means over the scenes of rmse_all, csf_rms and the root of
// low_frequency_noise over that of the scene's best; low_frequency_ratio and structured_fraction, means over the scenes
// (empty where a scene has none); structured_beyond_chance, 0 where the latter is within two of the standard errors
// that chance alone would give it; peaks, the number of scenes with a significant structured peak, and highest_peak_db
// of these; n_scenes; and rank_rmse, rank_csf, rank_low_frequency (of relative_low_frequency), rank_colour (of
// low_frequency_ratio) and rank_structured (of structured_beyond_chance), from 1, equal ones alike, empty for what has
// no value. In the order of filter, estimator and spp as they come, then by rank_rmse.
//
// relative_rmse, relative_low_frequency, low_frequency_ratio and structured_fraction have 95% intervals, _lo and _hi:
// the same means of the ends of the scenes' own intervals (of structured_fraction, two standard errors to either side),
// the scenes' best as it came out. That is right if the scenes of a trial err together, which they may since they share
// its samples, and too wide if they do not. They are empty where a scene has none: a pattern that does not vary has no
// intervals. csf_rms has none either. Chance is judged by the mean of the scenes' standard errors, for the same reason.
Table rank_noise(const Table& summary_rows);

}  // namespace moire
