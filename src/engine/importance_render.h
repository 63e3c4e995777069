// Images by importance sampling of the filter: each pixel has samples of its own, as dense as |k| is large, and all of
// equal weight but for the sign of k.
#pragma once

#include "engine/active_rows.h"
#include "engine/render.h"
#include "filters/filter.h"
#include "patterns/pattern.h"
#include "testimages/testimage.h"

namespace moire {

// What render() promises, for Estimator::importance and importance_ratio. Sums are whole numbers.
Rendered render_importance(const TestImage& scene, const Pattern& pattern, const Filter& filter, Estimator estimator,
                           const ActiveRows& rows, bool exhaustive);

}  // namespace moire
