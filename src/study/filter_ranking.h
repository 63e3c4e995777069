// Filters ranked over the scenes of a study, by what sampling adds and by what is left against box coverage.
#pragma once

#include "study/results.h"

namespace moire {

// `summary_rows` are those of summarize(). Rows without the columns of the measure `coverage` give none.
//
// One row per pattern, spp, filter and estimator that has all scenes: relative_sampling and relative_total, geometric
// means over the scenes of rmse_all (got - the filter's exact image) and rmse_coverage_all (got - coverage), each over
// that of the scene's best filter at that pattern and spp; and rank_sampling and rank_total, from 1. Errors are over
// all pixels of the image: the active pixels of a wide filter are more, and flatter, than those of a narrow one, so
// that a mean over active pixels would flatter it. A filter without error on a scene would make every other infinitely
// worse: such a scene is left out for that pattern and spp; where no scene is left, there are no rows.
// In the order of pattern and spp as they come, then by rank_total.
Table rank_filters(const Table& summary_rows);

}  // namespace moire
