// Filters ranked over the scenes of a study, by what sampling adds and by what is left against box coverage.
#pragma once

#include "study/results.h"

namespace moire {

// `rows` are the raw rows of a study. Rows without the columns of the measure `coverage` give none.
//
// One row per pattern, layout, spp, filter and estimator that has every scene and trial that any of them has:
// relative_sampling and relative_total are the errors rmse_all (got - the filter's exact image) and rmse_coverage_all
// (got - coverage) over those of the first in the ranking, geometric means over scenes and trials; each with _lo and
// _hi, a 95% interval (Student's t over trials: filters see the same samples in a trial, so the ratio is paired; none
// for one trial, 1 for the first itself), and rank_sampling and rank_total, from 1.
//
// Errors are over all pixels of the image: the active pixels of a wide filter are more, and flatter, than those of a
// narrow one, so that a mean over active pixels would flatter it. A scene and trial on which some filter has no error
// at all says nothing of ratios and is left out; where nothing is left, there are no rows.
// In the order of pattern, layout and spp as they come, then by rank_total.
Table rank_filters(const Table& rows);

}  // namespace moire
