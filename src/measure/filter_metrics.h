// What a reconstruction filter does, in numbers: blur, ringing, noise, aliasing. From its kernel alone, no images.
//
// Definitions, for a kernel k of integral 1 with K(x) = integral of k up to x and the frequency response
// H(f) = integral of k(x) exp(-2 pi i f x) dx, f in cycles per pixel; 1/2 is the Nyquist frequency:
//  - sample-frequency ripple: D. Mitchell and A. Netravali, "Reconstruction Filters in Computer Graphics", SIGGRAPH
//    1988. They ask that a flat field stay flat; the number that measures how far it does not is ours.
//  - smoothing, postaliasing, overshoot: S. Marschner and R. Lobb, "An Evaluation of Reconstruction Filters for Volume
//    Rendering", Visualization 1994, taken here in the plane, for k(x) k(y), where their integrals come apart into
//    powers of two numbers: the noise gain in one dimension, and its share inside the Nyquist band.
//  - noise gain: the equivalent noise bandwidth of F. Harris, "On the Use of Windows for Harmonic Analysis with the
//    Discrete Fourier Transform", Proc. IEEE 66(1), 1978, with sums turned into integrals.
//  - alias energy of an edge and anisotropy are ours.
//
// Radial filters have the same numbers, in the plane: radial_metrics.h.
//
// An asymmetric kernel is measured about its mean: a shift neither blurs nor rings. For even kernels, the whole
// catalogue but tables that a user brings, the mean is zero and nothing changes.
//
// Accuracy: absolute errors below 1e-13 for every kernel of the catalogue, which is what its own Chebyshev series
// (k_error() <= 1e-14) leaves, and below 5e-15 where the tests compare with long double; extrema are located, none is
// the largest of samples. The square of a kernel as narrow as 1/20 pixel is large: there the error of noise gain and
// postaliasing is 1e-13 of the noise gain.
#pragma once

#include "filters/kernel.h"

namespace moire {

struct FilterMetrics {
  double radius = 0;    // pixels
  double integral = 0;  // of the kernel as its source defines it, before it is divided by it
  // Largest |sum over integers j of k(phi + j) - 1| over all phases phi, one-sided limits at knots included. 0: a
  // partition of unity, H(n) = 0 for all integers n but 0, and the sum of an image is the area that it shows.
  double ripple = 0;
  double mean = 0;      // pixels: how far the kernel moves an image
  double variance = 0;  // pixels^2, about the mean: blur. Negative lobes may make it zero or negative
  // H(1/2), with the phase of the mean taken out: integral of k(x) cos(pi (x - mean)). Signed; 1 passes all.
  double nyquist_response = 0;
  double l1_gain = 0;            // integral of |k|: 1 without negative lobes; the most that it can magnify
  double overshoot_percent = 0;  // of a step, by its height: the larger of max K - 1 and -min K (the step down)
  double smoothing = 0;          // 1 - integral of |H|^2 over the Nyquist square; 0 keeps all, negative where H > 1
  double postaliasing = 0;       // integral of |H|^2 outside the Nyquist square
  // Integral of k^2, and its square for the image: a flat field of 1, taken as sum k / N over independent samples, N
  // per pixel and scattered without regard to pixels, has the variance noise_gain / N.
  double noise_gain_1d = 0, noise_gain = 0;
  // 2 times the integral over f > 1/2 of (|H(f)| / (2 pi f))^2: the energy (coverage^2 pixels, per pixel of its length)
  // that a filtered edge, upright or level, keeps above the Nyquist frequency and so as aliases.
  double edge_alias_energy = 0;
  // Largest less smallest |H(fx) H(fy)| on the circle fx^2 + fy^2 = 1/4: how much sharper one direction is. 0: round.
  double anisotropy = 0;
};

// The time is about that of 200 frequencies times the kernel's quadrature nodes (some ten per piece): below a
// millisecond for a filter of the catalogue; it grows as the square of the radius.
FilterMetrics filter_metrics(const Kernel& kernel);

}  // namespace moire
