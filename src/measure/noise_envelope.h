// How many independent numbers a mean of noise power holds. In the error of a rendered image noise is where the scene's
// boundary is: an edge of 200 active pixels has 200 independent numbers a trial, not one per bin, and intervals that
// take each bin for itself are far too narrow.
//
// Noise that is independent from pixel to pixel and has the energy e(x) (variance times squared window) at pixel x
// correlates two bins at distance d by E(d) / E(0), E the Fourier transform of e. For Gaussian noise the covariance of
// two powers is that, squared, and twice as much for a bin that is its own conjugate. So the mean of power over a set
// of bins that holds f with -f, of weights a, has the variance of chi-square of
//     (sum a)^2 / sum over pairs of bins a(k) a(l) |E(k - l) / E(0)|^2
// degrees of freedom: the number of bins where e is constant, about the number of noisy pixels where there are few.
// Noise of neighbouring pixels may depend on each other (filters wider than a pixel) as long as its colour varies
// slowly over the distances that E resolves.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "measure/spectrum.h"

namespace moire {

class NoiseEnvelope {
 public:
  // From the energies as the trials gave them; at least 2 trials, or noise that is zero.
  explicit NoiseEnvelope(const Spectra& spectra);

  // Degrees of freedom of a weighted mean of one realisation's noise power: between 1 and (sum a)^2 / sum a^2, the
  // value for uncorrelated bins; multiply with (trials - 1) for Spectra::noise. `weights` >= 0, one a bin, equal at f
  // and -f. 0 where there is no noise or no weight. Costs one transform of the image's size.
  double degrees(std::span<const double> weights) const;

  // The same of an unweighted mean over the bins at the given places of the array (Spectra::index), each once and all
  // with their conjugates. Costs a quarter of the squared number of bins, which is less for a ring.
  double degrees_of_set(std::span<const std::size_t> bins) const;

  // |E(2f)| / E(0), between 0 and 1: 0 where the real and the imaginary part of the spectrum's noise at bin (column,
  // row) are independent and alike, so that its power has two degrees of freedom; 1 where they are one number, as in
  // self-conjugate bins, or everywhere if only one pixel is noisy.
  double impropriety(int column, int row) const;

 private:
  // Estimate of |E(d)|^2, d in bins along both axes, -n <= d < n on one of n.
  double transform_squared(int d_column, int d_row) const;

  int width_, height_;
  // With the largest energy as the unit:
  double sum_squared_ = 0;                 // estimate of (sum e)^2
  std::vector<double> transform_squared_;  // of |E|^2, row-major, zero frequency first
  std::vector<double> correlation_;        // of sum over x of e(x) e(x + d), half, as transforms of real images (dft.h)
};

}  // namespace moire
