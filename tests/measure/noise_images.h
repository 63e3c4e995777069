// Error images of known spectra for the tests of src/measure: Gaussian white noise, tones, and noise that is only on a
// part of the image. Every value is a hash of its place.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <vector>

#include "core/hash.h"
#include "measure/spectrum.h"

namespace moire {

inline constexpr double kTau = 2 * std::numbers::pi;

// The relative difference; 0 for equal numbers, zeros too.
inline double relative(double got, double want) { return got == want ? 0 : std::fabs(got - want) / std::fabs(want); }

// A normal deviate of variance 1: G. E. P. Box and M. E. Muller, "A note on the generation of random normal deviates",
// 1958.
inline double gaussian(std::uint64_t seed, std::uint32_t trial, int x, int y) {
  const Words w = hash(pixel_key(draw_hash(seed, trial), {x, y}), 0, Axis::xy);
  return std::sqrt(-2 * std::log(1 - unit(w.a, w.b))) * std::cos(kTau * unit(w.c, w.d));
}

// Calls value(x, y) for all pixels, row by row.
template <class Value>
std::vector<double> image_of(int width, int height, const Value& value) {
  std::vector<double> image;
  image.reserve(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) image.push_back(value(x, y));
  }
  return image;
}

inline std::vector<double> white_noise(int width, int height, std::uint64_t seed, std::uint32_t trial) {
  return image_of(width, height, [&](int x, int y) { return gaussian(seed, trial, x, y); });
}

// The spectra of `trials` images of which image(trial) gives one each.
template <class Image>
Spectra spectra_of(int width, int height, SpectrumWindow window, int trials, const Image& image) {
  ErrorSpectra spectra(width, height, window);
  for (int t = 0; t < trials; ++t) spectra.add(image(static_cast<std::uint32_t>(t)));
  return spectra.finish();
}

inline Spectra white_spectra(int width, int height, SpectrumWindow window, int trials, std::uint64_t seed) {
  return spectra_of(width, height, window, trials,
                    [&](std::uint32_t t) { return white_noise(width, height, seed, t); });
}

}  // namespace moire
