// How visible an error is. Source beside the declarations.
#include "measure/contrast_sensitivity.h"

#include <cassert>
#include <cmath>

#include "core/sum.h"

namespace moire {

double contrast_sensitivity(double cycles_per_degree) {
  assert(cycles_per_degree >= 0);
  constexpr double kPeak = 0.98087787655726166;  // at f = 7.8909146: (0.0192 + u) 1.1 u^0.1 = 1
  const double u = 0.114 * cycles_per_degree;
  return 2.6 * (0.0192 + u) * std::exp(-std::pow(u, 1.1)) / kPeak;
}

double csf_weighted_rms(const Spectra& spectra, double pixels_per_degree) {
  assert(pixels_per_degree > 0);
  Sum sum;
  for (int row = 0; row < spectra.height; ++row) {
    for (int column = 0; column < spectra.width; ++column) {
      const double x = spectra.frequency_x(column), y = spectra.frequency_y(row);
      const double frequency = spectra.is_mean(column, row) ? 0.0 : std::sqrt(x * x + y * y);
      const double weight = contrast_sensitivity(frequency * pixels_per_degree);
      sum.add(spectra.total[spectra.index(column, row)] * (weight * weight));
    }
  }
  return std::sqrt(sum.value() / static_cast<double>(spectra.total.size()));
}

}  // namespace moire
