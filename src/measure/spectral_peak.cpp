// The strongest structured peak of an error spectrum.
#include "measure/spectral_peak.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <vector>

#include "measure/f_distribution.h"
#include "measure/noise_envelope.h"

namespace moire {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

// The total power of the bins around a bin.
std::vector<double> powers_around(const Spectra& s, int column, int row) {
  constexpr int kReach = 4;
  const int own = s.window == SpectrumWindow::hann ? 2 : 1;
  std::vector<double> around;
  // Along a short axis no bin may come twice.
  const int left = std::min(kReach, (s.width - 1) / 2), right = std::min(kReach, s.width / 2);
  const int up = std::min(kReach, (s.height - 1) / 2), down = std::min(kReach, s.height / 2);
  for (int dy = -up; dy <= down; ++dy) {
    for (int dx = -left; dx <= right; ++dx) {
      if (std::max(std::abs(dx), std::abs(dy)) <= own) continue;
      const int x = (column + dx + s.width) % s.width, y = (row + dy + s.height) % s.height;
      if (!s.is_mean(x, y)) around.push_back(s.total[s.index(x, y)]);
    }
  }
  return around;
}

// NaN where there are no bins.
double median_of(std::vector<double> around) {
  if (around.empty()) return kNan;
  std::sort(around.begin(), around.end());
  return 0.5 * (around[(around.size() - 1) / 2] + around[around.size() / 2]);
}

// The probability that a bin of one realisation, of which there is no other to compare, has its power or more if it is
// like the bins around it: the ratio of an exponential number to a mean of m of them is F(2, 2 m). Of the bins around,
// half at most are conjugates of each other.
double outlier_p_value(const Spectra& s, int column, int row) {
  const std::vector<double> around = powers_around(s, column, row);
  const double power = s.total[s.index(column, row)];
  double sum = 0;
  for (const double p : around) sum += p;
  if (!(power > 0)) return 1;
  if (!(sum > 0)) return around.empty() ? kNan : 0.0;
  const double m = 0.5 * static_cast<double>(around.size());
  const double ratio = power / (sum / static_cast<double>(around.size()));
  return std::exp(-m * std::log1p(ratio / m));
}

// A pattern that does not vary: all power is structured, and there is no noise to test it against.
bool is_single(const Spectra& s) {
  return s.trials == 1 && s.has_split() && std::all_of(s.noise.begin(), s.noise.end(), [](double v) { return v == 0; });
}

// The probability that noise alone gives a bin its mean spectrum or a larger one.
double bin_p_value(const Spectra& s, const NoiseEnvelope& envelope, int column, int row, double at_most) {
  const std::size_t i = s.index(column, row);
  const double t = static_cast<double>(s.trials);
  const double of_mean = s.structured[i] + s.noise[i] / t;  // |mean spectrum|^2
  if (!(s.noise[i] > 0)) return of_mean > 0 ? 0.0 : 1.0;
  const double f = t * of_mean / s.noise[i];
  // F(2, 2 (T - 1)) in closed form. The other distributions have longer tails, so that bins that fail here need no
  // more.
  const double proper = std::exp(-(t - 1) * std::log1p(f / (t - 1)));
  if (proper > at_most) return proper;
  const double degrees = 2 / (1 + envelope.impropriety(column, row));
  return f_survival(f, degrees, (t - 1) * degrees);
}

// Frequency and direction, with +1/2 for Nyquist.
void place(const Spectra& s, int column, int row, SpectralPeak& peak) {
  peak.column = column;
  peak.row = row;
  peak.fx = std::abs(s.frequency_x(column)) == 0.5 ? 0.5 : s.frequency_x(column);
  peak.fy = std::abs(s.frequency_y(row)) == 0.5 ? 0.5 : s.frequency_y(row);
  peak.direction = std::atan2(peak.fy, peak.fx) * (180 / std::numbers::pi);
}

}  // namespace

std::optional<SpectralPeak> strongest_peak(const Spectra& spectra, double false_alarms) {
  const bool tested = spectra.has_split();
  const std::vector<double>& power = tested ? spectra.structured : spectra.total;
  std::int64_t searched = 0;
  for (int row = 0; row < spectra.height; ++row) {
    for (int column = 0; column < spectra.width; ++column) {
      const bool here = spectra.is_first(column, row) && !spectra.is_mean(column, row);
      if (!here) continue;
      if (!std::isfinite(power[spectra.index(column, row)])) return std::nullopt;
      ++searched;
    }
  }
  if (searched == 0) return std::nullopt;

  const double bins = static_cast<double>(searched), limit = false_alarms / bins;
  std::optional<NoiseEnvelope> envelope;
  const bool single = is_single(spectra);
  if (tested && !single) envelope.emplace(spectra);
  SpectralPeak best;
  bool found = false;
  for (int row = 0; row < spectra.height; ++row) {
    for (int column = 0; column < spectra.width; ++column) {
      if (!spectra.is_first(column, row) || spectra.is_mean(column, row)) continue;
      const double p = single   ? outlier_p_value(spectra, column, row)
                       : tested ? bin_p_value(spectra, *envelope, column, row, limit)
                                : kNan;
      const bool significant = p <= limit;
      const double here = power[spectra.index(column, row)];
      const bool was = best.significant.value_or(false);
      if (found && (significant == was ? here <= best.power : was)) continue;
      found = true;
      place(spectra, column, row, best);
      best.power = here;
      best.significant = significant;
    }
  }

  best.searched = searched;
  best.p_value = kNan;
  if (single) {
    best.p_value = std::min(1.0, bins * outlier_p_value(spectra, best.column, best.row));
  } else if (tested) {
    best.p_value = std::min(1.0, bins * bin_p_value(spectra, *envelope, best.column, best.row, 1.0));
  }
  if (!tested) best.significant.reset();
  const double median = median_of(powers_around(spectra, best.column, best.row));
  best.height_db = best.power > 0 && median > 0 ? 10 * std::log10(best.power / median) : kNan;
  return best;
}

}  // namespace moire
