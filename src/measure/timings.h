// What repeated timings of one piece of work say: the middle and how far they scatter. Timings have a floor and a long
// tail, since other programs can only add to them; so medians, no means (J. W. Tukey, "Exploratory data analysis",
// 1977).
#pragma once

#include <span>

namespace moire {

// All in the unit of the timings; NaN for none.
struct TimingSpread {
  double median = 0;     // of an even number: half way between the middle two
  double deviation = 0;  // median absolute deviation from the median; of Gaussian scatter 0.674 standard deviations
  double least = 0, most = 0;
};

TimingSpread timing_spread(std::span<const double> timings);

}  // namespace moire
