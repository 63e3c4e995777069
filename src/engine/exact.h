// Exact filtered pixel values by one boundary integral for every separable filter, each with a guaranteed bound.
#pragma once

#include <vector>

#include "engine/active_rows.h"
#include "filters/filter.h"
#include "testimages/testimage.h"

namespace moire {

// |value - truth| <= bound, truth = integral of scene times normalised kernel for the stored doubles; of a moving
// scene, its mean over the time that the shutter is open.
struct Exact {
  double value = 0, bound = 0;
};

// The exact value of one pixel, also outside the image. `aim` matters where a scene has detail without end
// (HasWeightIntegral, HasRadialIntegral): smaller bounds take more time, and where they can not be had the bound says
// so. No bound is above half the integral of |k|, over the plane, which is what is known of every pixel. Pixels that
// are not active are exactly 0 or 1 with bound 0. Throws Error for a moving scene under a kernel of too many pieces
// (SweptIntegral::kMaxPieces); so does exact().
Exact exact_pixel(const TestImage& scene, const Filter& filter, Pixel pixel, const WeightAim& aim = {});

// The exact values of the active pixels, row-major as for_each_active counts them.
struct Reference {
  std::vector<double> value, bound;
  double max_bound = 0;
  double rms_bound = 0;  // root of the mean squared bound: what the reference may add to a root mean squared error
};
Reference exact(const TestImage& scene, const Filter& filter, const ActiveRows& rows, const WeightAim& aim = {});

}  // namespace moire
