// The strongest structured peak of an error spectrum: where Moire is, if it is there.
#pragma once

#include <cstdint>
#include <optional>

#include "measure/spectrum.h"

namespace moire {

struct SpectralPeak {
  int column = 0, row = 0;  // of the spectrum's array
  // Cycles per pixel to the right and downwards, each in (-1/2, 1/2], of the peak in the half plane fy > 0 (fy = 0:
  // fx > 0); its conjugate has the same power.
  double fx = 0, fy = 0;
  double direction = 0;  // degrees of (fx, fy) from +x towards +y, in [0, 180): across the stripes
  double power = 0;      // structured power of the bin; of a tone without window A^2 / 4 x pixels, if it is on a bin
  // Over the median of the total power around: 9 x 9 bins (the plane goes on periodically), without the 3 x 3 (hann:
  // 5 x 5) around the peak and those of the mean error. NaN where nothing is left, or the median or power is not > 0.
  double height_db = 0;

  // The test. Without structure T |mean spectrum|^2 / noise of a bin is F(2, 2 (T - 1)), of a bin whose real and
  // imaginary noise are not alike F(2 / (1 + r), (T - 1) 2 / (1 + r)), r its impropriety (noise_envelope.h): exact for
  // Gaussian noise and r = 0, or 1 (F(1, T - 1): self-conjugate bins), with the right tail between. p is for all
  // `searched` bins together (Bonferroni: p of the bin times their number, at most 1), each pair of conjugates once.
  std::int64_t searched = 0;
  double p_value = 0;               // NaN for one trial of a pattern that varies
  std::optional<bool> significant;  // p_value <= false_alarms; not known for such a trial
};

// Of the bins that are significant at the rate `false_alarms` (of finding any peak where there is none) the one with
// most structured power; if there is none, the one with most structured power of all, for what it is worth. For one
// trial of a pattern that varies: most total power, without a test. A pattern that does not vary has no noise to test
// its power against, and all of it is structured: there a bin is significant that stands out of the bins around it
// (those of height_db) as it would by chance with that rate, if they all were exponential numbers of one mean, F(2, 2
// m) with m half their number. The highest bin of one realisation of white noise is 10 dB or so above its median:
// height alone is no sign. The bins of the mean error (Spectra::is_mean) are not searched; nothing where no others are
// (images of 1 x 1; hann: 3 x 3) or where a number is not finite.
std::optional<SpectralPeak> strongest_peak(const Spectra& spectra, double false_alarms = 0.01);

}  // namespace moire
