// What a radial reconstruction filter does, in numbers: the fields of FilterMetrics (filter_metrics.h, which has the
// sources) for k(sqrt(x^2 + y^2)), in the plane.
//
// What is along one axis there is so here, for any axis: K(x) is the integral of the projection P
// (radial_projection.h), H its transform and so the Hankel transform of k (R. Bracewell, "The Fourier Transform and Its
// Applications", 1965), and variance, H(1/2), overshoot and edge alias energy follow. Integrals and sums that are of
// one axis there, to be squared, are of the plane here: `integral`, `ripple`, `l1_gain`. noise_gain_1d is the root of
// noise_gain: that of the separable filter with as much noise. mean and anisotropy are 0.
//
// Accuracy: absolute errors below 1e-13 for every kernel of the catalogue, against its definition; where a kernel is
// narrower than a pixel, of ripple, noise gain and postaliasing 1e-13 of the noise gain. Extrema are located;
// radial_ripple.h says how the ripple's may be missed.
#pragma once

#include "filters/radial_kernel.h"
#include "measure/filter_metrics.h"

namespace moire {

// The time grows as the cube of the radius, and with the pieces: a few milliseconds up to a radius of 3, some seconds
// for one of 32.
FilterMetrics filter_metrics(const RadialKernel& kernel);

}  // namespace moire
