// Spectra of signed error images over the trials of an experiment, split into what is the same in every realisation
// (structure: aliasing and Moire) and what differs (noise: grain). The periodogram is A. Schuster's (1898); the split
// is the variance decomposition per frequency bin, as one does it per pixel (statistics.h).
//
// Common to all files of image spectra:
// - Arrays are width x height, row-major, with zero frequency (DC) exactly at column width / 2 and row height / 2
//   (integer division). Column i has the frequency (i - width / 2) / width in cycles per pixel to the right, row j
//   (j - height / 2) / height downwards. For an even side the first column or row is Nyquist, -1/2.
// - Power is power per pixel: without a window its mean over all width x height bins is the mean squared error
//   (Parseval). White noise has its variance in every bin; A cos(2 pi f x + p) with f on a bin (and not its own
//   conjugate) has A^2 / 4 times the number of pixels in its two bins.
// - Real images: P(-f) = P(f), exactly, here. Such a pair of bins is one random number with two degrees of freedom.
#pragma once

#include <complex>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "measure/trial_products.h"

namespace moire {

// What the image is multiplied with before the transform.
enum class SpectrumWindow {
  none,
  // sin^2(pi x / width) sin^2(pi y / height) at pixel centres (periodic Hann, moved by half a pixel: it is symmetric in
  // the image and not zero in any pixel). An image that does not go on periodically, such as an edge that leaves it,
  // else spreads its power along the axes. Power is divided by the mean of the squared window, so that the level of
  // white noise is unchanged. A pure tone is spread over 3 x 3 bins; so is the mean error. Rings, shares and the eye's
  // weights therefore take all of these nine bins for zero frequency (Spectra::is_mean). To subtract the mean before
  // the window would empty them of what else is there: of white noise 4/9 in the four bins on the axes, 16/81 in the
  // corners; and what the window has mixed no factor can part again.
  hann,
};

// Names as studies and the command line have them, in the order of the enumeration.
std::span<const std::string_view> window_names();
std::string_view name_of(SpectrumWindow window);
// Throws Error with the names.
SpectrumWindow find_window(std::string_view name, std::string_view place);

// The window's values along one axis of n pixels.
std::vector<double> window_values(SpectrumWindow window, int n);

struct Spectra {
  int width = 0, height = 0;
  SpectrumWindow window = SpectrumWindow::none;
  std::int64_t trials = 0;

  // Mean over the trials of the periodogram.
  std::vector<double> total;
  // |mean spectrum|^2 less its expectation under noise, noise / trials: unbiased, and so negative here and there. Never
  // clamped: a mean over bins stays unbiased. Where a pattern varies, one trial tells nothing of the split, and this,
  // `noise` and `energy` are empty; everything derived from them is then NaN or absent.
  std::vector<double> structured;
  // Variance of one trial's spectrum around the mean spectrum, divisor trials - 1: unbiased.
  // total = structured + noise up to rounding.
  std::vector<double> noise;
  // Per pixel: squared window times the sample variance of the error. Where in the image the noise is, which decides
  // how much the noise of different bins has to do with each other (noise_envelope.h).
  std::vector<double> energy;
  // Of the trials among themselves, for standard errors; without the bins of the mean error.
  TrialProducts products;
  // What theory expects `noise` to be (noise_theory.h), where somebody knows and sets it; else empty.
  std::vector<double> expected;

  bool has_split() const noexcept { return !noise.empty(); }
  std::size_t index(int column, int row) const noexcept {
    return static_cast<std::size_t>(std::int64_t{row} * width + column);
  }
  double frequency_x(int column) const noexcept { return static_cast<double>(column - width / 2) / width; }
  double frequency_y(int row) const noexcept { return static_cast<double>(row - height / 2) / height; }
  // The bin is zero frequency or holds the mean error's leakage through the window: the 3 x 3 bins in the middle for
  // hann, one bin without window, and along an axis of 1 or 2 pixels, where the window is constant.
  bool is_mean(int column, int row) const noexcept;
  // 1 for the bins of which is_mean() is true, in the order of the arrays.
  std::vector<std::uint8_t> mean_bins() const;
  // Of each pair of conjugate bins exactly one is first, and bins that are their own conjugate are.
  bool is_first(int column, int row) const noexcept;
};

// Collects trials. Keeps bytes_per_pixel() and needs 32 more per pixel while it adds. Not to be shared between threads;
// several objects may be in use at once. The same bits for any number of threads.
class ErrorSpectra {
 public:
  // What is kept of each pixel after so many trials; up to 8 bytes a row of pixels more. At most 156.
  static constexpr std::int64_t bytes_per_pixel(std::int64_t trials) {
    return 28 + TrialGroups::bytes_per_pixel(trials);
  }

  // Any size from 1 x 1 on.
  ErrorSpectra(int width, int height, SpectrumWindow window);

  // One trial: signed errors (got - exact, in units of coverage), row-major, width x height. The order of trials
  // decides the last bits. Squares must neither overflow nor underflow: |error| within about 1e-140 .. 1e140, or 0. A
  // value that is not finite makes every number of the result NaN.
  void add(std::span<const double> error);
  std::int64_t trials() const noexcept { return trials_; }

  // At least one trial. `varies`: false for a pattern without random numbers, whose one trial is all there is to know:
  // then, for one trial, all power is structured and noise is exactly zero.
  Spectra finish(bool varies = true) const;

 private:
  int width_, height_;
  SpectrumWindow window_;
  std::vector<double> window_x_, window_y_;
  std::int64_t trials_ = 0;
  std::vector<std::complex<double>> mean_;  // of the half spectrum (dft.h)
  std::vector<double> deviations_;          // sums of |spectrum - mean|^2 of the half spectrum
  std::vector<double> pixel_mean_, pixel_deviations_;
  TrialGroups groups_;
};

}  // namespace moire
