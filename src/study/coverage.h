// Images against box coverage. What a filter is asked to do beyond averaging over the pixel (to blur, to sharpen) is an
// error by this measure; beside the error against the filter's own exact image it shows which of the two is large.
#pragma once

#include "engine/render.h"
#include "measure/error.h"
#include "study/truth.h"

namespace moire {

// Over the pixels that are active under the filter or under the box, and over all.
struct CoverageErrors {
  Errors active, all;
};

// got - coverage. `got` was rendered for `rows`; `box` is the scene's truth under the box filter of width 1.
CoverageErrors coverage_errors(const ActiveRows& rows, const Rendered& got, const Truth& box);

}  // namespace moire
