// Radial means of an error image's spectra.
#include "measure/radial_spectrum.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "measure/chi_square.h"
#include "measure/noise_envelope.h"

namespace moire {
namespace {

// The places of each ring's bins.
std::vector<std::vector<std::size_t>> bins_of_rings(const Spectra& s, std::size_t count) {
  std::vector<std::vector<std::size_t>> bins(count);
  for (int row = 0; row < s.height; ++row) {
    for (int column = 0; column < s.width; ++column) {
      if (s.is_mean(column, row)) continue;
      bins[static_cast<std::size_t>(ring_of_bin(s, column, row))].push_back(s.index(column, row));
    }
  }
  return bins;
}

// Adds what depends on the noise to all rings.
void judge(const Spectra& s, std::vector<RadialSpectrum>& out) {
  const std::vector<Ring> structured = rings(s.structured, s.width, s.height, s.mean_bins());
  const std::vector<Ring> noise = rings(s.noise, s.width, s.height, s.mean_bins());
  const NoiseEnvelope envelope(s);
  const double t = static_cast<double>(s.trials);
  const std::vector<std::vector<std::size_t>> bins = bins_of_rings(s, noise.size());
  for (std::size_t k = 1; k < noise.size(); ++k) {
    RadialSpectrum& ring = out[k - 1];
    ring.structured = structured[k].mean;
    ring.noise = noise[k].mean;
    if (s.trials == 1) {  // a pattern that does not vary: noise is exactly 0
      ring.structured_error = 0;
      continue;
    }
    const double one_trial = envelope.degrees_of_set(bins[k]);
    ring.degrees = one_trial * (t - 1);
    if (!(one_trial > 0)) {
      ring.structured_error = ring.noise;  // 0, or NaN where there are no bins
      continue;
    }
    // |mean|^2 has the expectation noise / T with the relative variance 2 / degrees, and noise / T, subtracted,
    // 2 / (degrees (T - 1)).
    ring.structured_error = ring.noise / t * std::sqrt(2 / one_trial * t / (t - 1));
    ring.noise_interval = power_interval(ring.noise, ring.degrees);
  }
}

}  // namespace

int ring_of_bin(const Spectra& spectra, int column, int row) {
  const double larger = std::max(spectra.width, spectra.height);
  return ring_of((column - spectra.width / 2) * (larger / spectra.width),
                 (row - spectra.height / 2) * (larger / spectra.height));
}

std::vector<RadialSpectrum> radial_spectrum(const Spectra& spectra) {
  const std::vector<std::uint8_t> mean = spectra.mean_bins();
  const std::vector<Ring> total = rings(spectra.total, spectra.width, spectra.height, mean);
  std::vector<Ring> expected;
  if (!spectra.expected.empty()) expected = rings(spectra.expected, spectra.width, spectra.height, mean);
  std::vector<RadialSpectrum> out;
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  for (std::size_t k = 1; k < total.size(); ++k) {
    RadialSpectrum ring;
    ring.frequency = static_cast<double>(k) / std::max(spectra.width, spectra.height);
    ring.total = total[k];
    ring.structured = ring.noise = ring.structured_error = kNan;
    ring.expected = expected.empty() ? kNan : expected[k].mean;
    out.push_back(ring);
  }
  if (spectra.has_split()) judge(spectra, out);
  return out;
}

}  // namespace moire
