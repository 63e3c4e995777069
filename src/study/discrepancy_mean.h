// Means of a discrepancy over sets of points.
#pragma once

#include <vector>

namespace moire {

// Mean and root mean square of T (or D), and the standard errors of the mean and of the mean square: NaN for one value.
struct DiscrepancyMean {
  double mean = 0, rms = 0, standard_error = 0, square_error = 0;
};
DiscrepancyMean mean_over_sets(const std::vector<double>& values);

}  // namespace moire
