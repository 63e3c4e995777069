// What part of an error's power is where, in single numbers.
#include "measure/spectral_shares.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include "core/sum.h"
#include "measure/chi_square.h"
#include "measure/f_distribution.h"
#include "measure/noise_envelope.h"
#include "measure/radial.h"
#include "measure/radial_spectrum.h"

namespace moire {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

// A smooth estimate of each bin's noise power: the mean of its ring. Bins of the mean error: 0.
std::vector<double> radial_noise(const Spectra& s) {
  const std::vector<Ring> means = rings(s.noise, s.width, s.height, s.mean_bins());
  std::vector<double> power;
  power.reserve(s.noise.size());
  for (int row = 0; row < s.height; ++row) {
    for (int column = 0; column < s.width; ++column) {
      const int ring = ring_of_bin(s, column, row);
      power.push_back(s.is_mean(column, row) ? 0.0 : means[static_cast<std::size_t>(ring)].mean);
    }
  }
  return power;
}

enum class Part { mean, low, other };

std::vector<Part> parts(const Spectra& s) {
  std::vector<Part> out;
  out.reserve(s.total.size());
  for (int row = 0; row < s.height; ++row) {
    for (int column = 0; column < s.width; ++column) {
      const double x = s.frequency_x(column), y = s.frequency_y(row), squared = x * x + y * y;
      out.push_back(s.is_mean(column, row)                    ? Part::mean
                    : squared < kLowFrequency * kLowFrequency ? Part::low
                                                              : Part::other);
    }
  }
  return out;
}

}  // namespace

LowFrequencyRatio low_frequency_ratio(const Spectra& spectra) {
  LowFrequencyRatio out{kNan, std::nullopt, kNan, std::nullopt};
  if (!spectra.has_split()) return out;
  struct Mean {
    Sum sum;
    double bins = 0;
  } low, other;
  const std::vector<Part> part = parts(spectra);
  for (std::size_t i = 0; i < part.size(); ++i) {
    if (part[i] == Part::mean) continue;
    Mean& mean = part[i] == Part::low ? low : other;
    mean.sum.add(spectra.noise[i]);
    ++mean.bins;
  }
  const double share = low.bins / (low.bins + other.bins);  // of the bins
  const double all = (low.sum.value() + other.sum.value()) / (low.bins + other.bins);
  if (!(low.bins > 0) || !(other.bins > 0) || !(all > 0)) return out;
  out.low = low.sum.value() / low.bins;
  out.ratio = out.low / all;

  const NoiseEnvelope envelope(spectra);
  std::vector<double> low_weights = radial_noise(spectra), other_weights = low_weights;
  for (std::size_t i = 0; i < part.size(); ++i) (part[i] == Part::low ? other_weights : low_weights)[i] = 0;
  const double more_trials = static_cast<double>(spectra.trials - 1);
  const double low_degrees = more_trials * envelope.degrees(low_weights);
  const double other_degrees = more_trials * envelope.degrees(other_weights);
  if (!(low_degrees > 0) || !(other_degrees > 0)) return out;
  // ratio = F / (share F + 1 - share) with F the mean of the low over that of the others: it grows with F.
  const double f = out.low / (other.sum.value() / other.bins);
  const auto ratio_of = [share](double quotient) { return quotient / (share * quotient + (1 - share)); };
  const Interval spread = f95(low_degrees, other_degrees);
  out.interval = Interval{ratio_of(f / spread.hi), ratio_of(f / spread.lo)};
  out.low_interval = power_interval(out.low, low_degrees);
  return out;
}

std::optional<Interval> noise_power_interval(const Spectra& spectra) {
  if (!spectra.has_split()) return std::nullopt;
  Sum sum;
  for (const double p : spectra.noise) sum.add(p);
  // Bins of the mean error, few among many, have no weight.
  const double degrees =
      static_cast<double>(spectra.trials - 1) * NoiseEnvelope(spectra).degrees(radial_noise(spectra));
  if (!(degrees > 0)) return std::nullopt;
  return power_interval(sum.value() / static_cast<double>(spectra.noise.size()), degrees);
}

StructuredFraction structured_fraction(const Spectra& spectra) {
  StructuredFraction out{kNan, kNan, kNan, kNan};
  if (!spectra.has_split()) return out;
  Sum structured, total, noise, structured_all, total_all;
  for (int row = 0; row < spectra.height; ++row) {
    for (int column = 0; column < spectra.width; ++column) {
      const std::size_t i = spectra.index(column, row);
      structured_all.add(spectra.structured[i]);
      total_all.add(spectra.total[i]);
      if (spectra.is_mean(column, row)) continue;
      structured.add(spectra.structured[i]);
      total.add(spectra.total[i]);
      noise.add(spectra.noise[i]);
    }
  }
  if (total_all.value() > 0) out.fraction_with_dc = structured_all.value() / total_all.value();
  if (!(total.value() > 0)) return out;
  out.fraction = structured.value() / total.value();
  out.error = out.chance = 0;
  if (!(noise.value() > 0)) return out;
  const double t = static_cast<double>(spectra.trials), pairs = t * (t - 1);
  const double bins = static_cast<double>(spectra.total.size()), power = total.value() / bins;
  // Of tr C^2, C the covariance of a trial's error. The power of a Gaussian trial has the mean tr C and the variance
  // 2 tr C^2, and so (tr C)^2 / tr C^2 degrees of freedom.
  const double covariance = noise.value() / bins / power;
  const double least = covariance * covariance / NoiseEnvelope(spectra).degrees(radial_noise(spectra));
  const double squared = std::fmax(least, spectra.products.squared_covariance(power));  // fmax leaves out NaN
  const double chance = 2 * squared / pairs;
  out.chance = std::sqrt(chance);
  out.error = std::sqrt(chance + spectra.products.linear_variance(out.fraction, spectra.trials, power));
  return out;
}

}  // namespace moire
