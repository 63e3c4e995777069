// What part of an error's power is where, in single numbers: low frequencies' part of the noise, structure's part of
// the whole.
#pragma once

#include <optional>

#include "measure/spectrum.h"
#include "measure/statistics.h"

namespace moire {

// Frequencies below this, in cycles per pixel, count as low: grain of eight pixels and more.
inline constexpr double kLowFrequency = 0.125;

// Mean noise power over the bins with 0 < |f| < kLowFrequency, over that of all bins but zero frequency: 1 for white
// noise, below 1 for blue noise.
struct LowFrequencyRatio {
  double ratio = 0;                  // NaN without noise, or in images too small to have low and other frequencies
  std::optional<Interval> interval;  // 95%, from F; none where ratio is NaN
};

// Interval: the means of low and of other frequencies are taken as independent chi-squares of as many degrees of
// freedom as noise_envelope.h gives, bins weighted with the mean power of their rings, since those of little power add
// little. Where noise is not the same all over the image the two means rise and fall together, and the interval is too
// wide.
LowFrequencyRatio low_frequency_ratio(const Spectra& spectra);

// Sums of structured power over sums of total power: 0 where all is noise (negative by chance), 1 where all is the same
// in each trial. NaN without the split, or without power.
struct StructuredFraction {
  double fraction = 0;          // without the bins of the mean error (Spectra::is_mean): it is bias, not a picture
  double fraction_with_dc = 0;  // over all bins
  // Standard error that `fraction` has where there is no structure, for noise whose bins are independent but for what
  // noise_envelope.h knows. A set over a whole image that has but a few random numbers in all (one shift, one scramble)
  // makes bins that move together: there the true error was seen to be 2 to 10 times as large.
  double error = 0;
};
StructuredFraction structured_fraction(const Spectra& spectra);

}  // namespace moire
