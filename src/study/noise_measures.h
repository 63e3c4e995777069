// The measure `spectrum`: what the errors of a case's trials look like, as columns of its last trial's row.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <tuple>

#include "measure/spectrum.h"
#include "study/run.h"

namespace moire {

// Largest image whose spectra are taken, in pixels: each case of a scene that is under way keeps 28 bytes per pixel.
inline constexpr std::int64_t kMaxSpectrumPixels = std::int64_t{1} << 22;
// And its longer side: a transform of n values takes time as n^2 where n is prime.
inline constexpr int kMaxSpectrumSide = 1 << 13;
constexpr bool has_spectrum(Grid grid) {
  return std::int64_t{grid.width} * grid.height <= kMaxSpectrumPixels && grid.width <= kMaxSpectrumSide &&
         grid.height <= kMaxSpectrumSide;
}

// Sets the columns kSpectrumColumns (columns.h), which say how a spectrum was taken and what it shows: spectrum_window;
// noise_power and structured_power (means over all bins: parts of the mean squared error over all pixels, zero
// frequency included); low_frequency_ratio with _lo and _hi, and times noise_power
// low_frequency_noise; structured_fraction and structured_fraction_error;
// peak_fx, peak_fy, peak_frequency (cycles per pixel), peak_direction (degrees), peak_height_db, peak_p and
// peak_significant of the strongest structured peak; csf_rms. See measure/spectral_shares.h, spectral_peak.h and
// contrast_sensitivity.h. Cells are empty where a number does not exist: a pattern that does not vary has no noise.
void set_spectrum(Row& row, const Spectra& spectra, double pixels_per_degree);

// Radial means of the spectra, one row per ring (measure/radial_spectrum.h): frequency, bins, total, structured,
// structured_error, noise, noise_lo, noise_hi, degrees, anisotropy_db.
Table radial_rows(const Spectra& spectra);

class NoiseMeasures {
 public:
  explicit NoiseMeasures(const Study& study) : study_(study) {}

  // Takes one trial of a case, of all trials in order. After the last one of `trials` sets the columns in its row and
  // gives the spectra; before, and in a study that does not measure `spectrum`, nothing.
  std::optional<Spectra> add(const Case& c, std::uint32_t trials, const Truth& truth, CaseResult& result);
  // Forgets what is not complete: other patterns and counts follow.
  void clear() { under_way_.clear(); }

 private:
  const Study& study_;
  std::map<std::tuple<std::uint32_t, std::uint32_t, std::uint32_t, std::uint32_t>, ErrorSpectra> under_way_;
};

}  // namespace moire
