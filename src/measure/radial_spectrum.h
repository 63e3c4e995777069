// Radial means of an error image's spectra, with what is needed to judge them.
#pragma once

#include <optional>
#include <vector>

#include "measure/radial.h"
#include "measure/spectrum.h"
#include "measure/statistics.h"

namespace moire {

// Rings as in radial.h: ring k is centred on k / max(width, height) cycles per pixel and as wide as one step of k;
// zero frequency is left out, and so is what the window makes of it (Spectra::is_mean): with window hann a square
// image's ring 1 has no bins. Rings above 1/2 hold the corners of the frequency square only, the last one the corner
// itself, at 1 / sqrt(2). Without bins, and without the split (spectrum.h), means are NaN.
struct RadialSpectrum {
  double frequency = 0;  // cycles per pixel, of the ring's middle
  // Of Spectra::total: bins, mean, and anisotropy. White noise of T trials has an anisotropy of about -10 log10(T) dB.
  // (With window hann neighbouring bins are alike: rings of few bins come out too isotropic.)
  Ring total;
  double structured = 0, noise = 0;  // means over the bins
  double expected = 0;               // of Spectra::expected; NaN where there is none
  // Standard error of `structured` where there is no structure: the error of an estimate of 0.
  double structured_error = 0;
  // Of `noise`: (trials - 1) x those of one realisation, which are the ring's bins (a conjugate pair counts once, with
  // two degrees) if the noise has the same variance all over the image, and fewer if not (noise_envelope.h).
  double degrees = 0;
  std::optional<Interval> noise_interval;  // 95%, from chi-square; none without degrees
};

// The ring of a bin of the array; 0: zero frequency.
int ring_of_bin(const Spectra& spectra, int column, int row);

// Element 0 is ring 1. Takes time as the cube of the larger side.
std::vector<RadialSpectrum> radial_spectrum(const Spectra& spectra);

}  // namespace moire
