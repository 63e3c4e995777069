// Quantiles of the chi-square distribution, and with them the interval of a mean power.
#pragma once

#include "measure/statistics.h"

namespace moire {

// The numbers that chi-square of `degrees` > 0 degrees of freedom stays below with probability 2.5% (lo) and 97.5%
// (hi); to 1e-10 relative.
Interval chi_square95(double degrees);

// The 95% interval of the true mean of power whose average over `degrees` > 0 degrees of freedom came out as `mean`,
// when each degree is the square of a Gaussian number and all have the same variance.
Interval power_interval(double mean, double degrees);

}  // namespace moire
