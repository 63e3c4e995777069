// Patterns ranked on each scene by their errors, at equal samples and at equal time.
#pragma once

#include "study/results.h"

namespace moire {

// `summary_rows` (study/summary.h) with two columns more, of the raw rows behind each: time_render_ns, the median over
// trials (and lines), and time_per_active_pixel_ns, the median of each image's time over its active pixels.
Table with_times(Table summary_rows, const Table& rows);

// One row per row of with_times() that has an error, in their order: scene, filter, estimator, pattern, layout, spp;
//   relative_rmse: rmse_active over that of the best pattern of the scene, filter, estimator and spp; rank, equal ones
//     alike; relative_rmse_lo and _hi, 95%: the two errors' own intervals, taken for independent, added in the
//     logarithm as squares; a pattern that does not vary counts as known exactly, and the best itself has the interval
//     [1, 1];
//   relative_at_equal_time and rank_at_equal_time: the same for the errors that patterns reach within one time of
//     rendering (without setup, as in `moire bench`): the median over the patterns of their times at the row's spp. A
//     pattern's error is read from the line through its own points in log time and log error, times above those of
//     larger counts cut down to these; beyond the study's largest count it stays what it is there, and it is empty for
//     a pattern whose smallest count takes longer. Times of a run are taken once: images of a millisecond say little.
Table rank_patterns(const Table& timed_rows);

}  // namespace moire
