// The measure `spectrum`: what the errors of a case's trials look like, as columns of its last trial's row.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <tuple>

#include "measure/spectrum.h"
#include "study/expected_noise.h"
#include "study/run.h"

namespace moire {

// Largest image whose spectra are taken, in pixels.
inline constexpr std::int64_t kMaxSpectrumPixels = std::int64_t{1} << 22;
// And its longer side: a transform of n values takes time as n^2 where n is prime.
inline constexpr int kMaxSpectrumSide = 1 << 13;
constexpr bool has_spectrum(Grid grid) {
  return std::int64_t{grid.width} * grid.height <= kMaxSpectrumPixels && grid.width <= kMaxSpectrumSide &&
         grid.height <= kMaxSpectrumSide;
}

// Bytes that all cases of a scene under way together may take. Trials run outside the scenes, layouts, filters and
// estimators, so that the spectra of all of these grow together, by ErrorSpectra::bytes_per_pixel() each.
inline constexpr std::int64_t kMaxSpectrumBytes = std::int64_t{1} << 31;
std::int64_t spectrum_bytes(const Study& study, std::uint32_t scene);

// Throws Error, with the numbers, for a study that names the measure and has a scene beyond these limits.
void require_spectra(const Study& study);

// Sets the columns kSpectrumColumns (columns.h), which say how a spectrum was taken and what it shows: spectrum_window;
// noise_power, with _lo and _hi, and structured_power (means over all bins: parts of the mean squared error over all
// pixels, zero frequency included); expected_noise_power (likewise; expected_noise.h says where it is known);
// low_frequency_ratio, and low_frequency_noise, noise power per bin below 1/8 cycle per pixel without zero frequency,
// with _lo and _hi each; structured_fraction and its standard errors structured_fraction_error and
// structured_fraction_chance; peak_fx, peak_fy, peak_frequency (cycles per pixel), peak_direction (degrees),
// peak_height_db, peak_p and peak_significant of the strongest structured peak; csf_rms. See measure/spectral_shares.h,
// spectral_peak.h and contrast_sensitivity.h. Cells are empty where a number does not exist: a pattern that does not
// vary has no noise.
void set_spectrum(Row& row, const Spectra& spectra, double pixels_per_degree);

// Radial means of the spectra, one row per ring (measure/radial_spectrum.h): frequency, bins, total, structured,
// structured_error, noise, noise_lo, noise_hi, expected, degrees, anisotropy_db.
Table radial_rows(const Spectra& spectra);

class NoiseMeasures {
 public:
  explicit NoiseMeasures(const Study& study) : study_(study), theory_(study) {}

  // Takes one trial of a case, of all trials in order. After the last one of `trials` sets the columns in its row and
  // gives the spectra; before, and in a study that does not measure `spectrum`, nothing.
  std::optional<Spectra> add(const Case& c, std::uint32_t trials, const Truth& truth, CaseResult& result);
  // Forgets what is not complete: other patterns and counts follow.
  void clear() { under_way_.clear(); }

 private:
  const Study& study_;
  ExpectedNoise theory_;
  std::map<std::tuple<std::uint32_t, std::uint32_t, std::uint32_t, std::uint32_t>, ErrorSpectra> under_way_;
};

}  // namespace moire
