// Noise of a constant scene. The ratio estimator divides it out, and pays for it elsewhere; the unnormalised one shows
// it: a pixel of a scene that is 1 everywhere is the sum of its weights over their expectation, and that is not 1.
#pragma once

#include "engine/samples.h"
#include "filters/filter.h"

namespace moire {

// The image over which flat_field_rms takes its mean.
inline constexpr Grid kFlatField{32, 32};

// RMS over the pixels of kFlatField of sum k / rho - 1, k the filter's weights and rho the pattern's samples per pixel.
// For rho independent uniform samples in every pixel its square has the expectation (E^2 - M^2) / rho, where E is the
// integral of k^2 in one dimension and M the sum of the squares of k's integrals over the pixels (ours: the noise gain
// of Mitchell and Netravali's flat field, less what a fixed number of samples in each pixel takes away).
//
// A set over the image must be of the size of kFlatField.
double flat_field_rms(Samples samples, const Filter& filter);

}  // namespace moire
