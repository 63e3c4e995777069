// What part of an error's power is where, in single numbers: low frequencies' part of the noise, structure's part of
// the whole.
#pragma once

#include <optional>

#include "measure/spectrum.h"
#include "measure/statistics.h"

namespace moire {

// Frequencies below this, in cycles per pixel, count as low: grain of eight pixels and more.
inline constexpr double kLowFrequency = 0.125;

// Mean noise power over the bins with |f| < kLowFrequency, over that of all bins: 1 for white noise, below 1 for blue
// noise. Zero frequency is in neither (with window hann: the bins of Spectra::is_mean): it is the scatter of the bias,
// not grain.
struct LowFrequencyRatio {
  double ratio = 0;                  // NaN without noise, or in images too small to have low and other frequencies
  std::optional<Interval> interval;  // 95%, from F; none where ratio is NaN
  // The first of the two means itself, power per pixel, with its 95% interval from chi-square; NaN and none likewise.
  double low = 0;
  std::optional<Interval> low_interval;
};

// Interval of the ratio: the means of low and of other frequencies are taken as independent chi-squares of as many
// degrees of freedom as noise_envelope.h gives, bins weighted with the mean power of their rings, since those of little
// power add little. Where noise is not the same all over the image the two means rise and fall together, and the
// interval is too wide.
LowFrequencyRatio low_frequency_ratio(const Spectra& spectra);

// The 95% interval of the mean of Spectra::noise over all bins, from chi-square with the degrees of freedom of
// noise_envelope.h; none without noise or without the split.
std::optional<Interval> noise_power_interval(const Spectra& spectra);

// Sums of structured power over sums of total power: 0 where all is noise (negative by chance), 1 where all is the same
// in each trial. NaN without the split, or without power.
struct StructuredFraction {
  double fraction = 0;          // without the bins of the mean error (Spectra::is_mean): it is bias, not a picture
  double fraction_with_dc = 0;  // over all bins
  // Standard errors of `fraction`: as it is, and as it would be by chance without any structure, the second being part
  // of the first. Both from the trials' products among themselves (trial_products.h), so that they hold for noise whose
  // bins move together, too, as under a set over the whole image with but a few random numbers (one shift, one scramble
  // a trial). The second is never below what independent pixels of the measured energies would have (noise_envelope.h);
  // fewer than 4 trials know no more than that.
  double error = 0, chance = 0;
};
StructuredFraction structured_fraction(const Spectra& spectra);

}  // namespace moire
