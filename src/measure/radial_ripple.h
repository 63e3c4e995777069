// Sample-frequency ripple of a radial kernel: how far a flat field that is sampled once a pixel is from flat.
//
// D. Mitchell and A. Netravali, "Reconstruction Filters in Computer Graphics", SIGGRAPH 1988, in the plane.
#pragma once

#include "filters/radial_kernel.h"

namespace moire {

// Largest |sum over all integers i, j of k(|(x + i, y + j)|) - 1| over all phases (x, y), one-sided limits at jumps of
// k included: never more than the truth but for rounding (1e-15 of the sum of |k|). The maximum may lie inside, where a
// grid of 1/64 pixel is refined; on the circles where k jumps or bends, which are followed in steps of 1/64 pixel; or
// where two circles with jumps meet, which is solved for. Located to 1e-8 pixel inside, where maxima are
// flat, and to 1e-14 along circles: 1e-13 of the largest |k| is reached but for features narrower than the steps.
double radial_ripple(const RadialKernel& kernel);

}  // namespace moire
