// Images under the unit box: every weight is 1 and every window is one cell, so that a pixel is a count of its samples.
#pragma once

#include "engine/active_rows.h"
#include "engine/render.h"
#include "patterns/pattern.h"
#include "testimages/testimage.h"

namespace moire {

// What render() promises, of a pattern in every pixel under the unit box, for a scene that stands still: the same bits,
// as the sums are whole numbers.
Rendered render_box(const TestImage& scene, const Pattern& pattern, Estimator estimator, const ActiveRows& rows,
                    bool exhaustive);

}  // namespace moire
