// A power law through measurements.
#include "measure/power_law.h"

#include <cmath>
#include <vector>

namespace moire {

std::optional<PowerLaw> fit_power_law(std::span<const PowerPoint> points) {
  std::vector<PowerPoint> logs;
  PowerLaw law;
  double x_mean = 0, y_mean = 0;
  for (const PowerPoint& p : points) {
    if (!(p.n > 0 && p.y > 0) || !std::isfinite(p.n) || !std::isfinite(p.y)) continue;
    law.n_min = logs.empty() ? p.n : std::fmin(law.n_min, p.n);
    law.n_max = std::fmax(law.n_max, p.n);
    logs.push_back({std::log(p.n), std::log(p.y)});
    x_mean += logs.back().n;
    y_mean += logs.back().y;
  }
  // Told by n itself: rounding may leave equal logarithms a little off their mean.
  if (law.n_min == law.n_max) return std::nullopt;
  law.points = static_cast<int>(logs.size());
  const double count = static_cast<double>(logs.size());
  x_mean /= count;
  y_mean /= count;
  double xx = 0, xy = 0;
  for (const PowerPoint& p : logs) {
    xx += (p.n - x_mean) * (p.n - x_mean);
    xy += (p.n - x_mean) * (p.y - y_mean);
  }
  if (!(xx > 0)) return std::nullopt;  // n so close that their logarithms are one
  law.exponent = xy / xx;
  law.factor = std::exp(y_mean - law.exponent * x_mean);
  if (law.points < 3) return law;
  double squares = 0;
  for (const PowerPoint& p : logs) {
    const double off = p.y - y_mean - law.exponent * (p.n - x_mean);
    squares += off * off;
  }
  const double half = student_t95(law.points - 2) * std::sqrt(squares / (count - 2) / xx);
  law.interval = Interval{law.exponent - half, law.exponent + half};
  return law;
}

}  // namespace moire
