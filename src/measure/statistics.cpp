// Statistics over trials. Sources beside the declarations.
#include "measure/statistics.h"

#include <cassert>
#include <cmath>
#include <numeric>
#include <limits>

#include "core/sum.h"

namespace moire {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kPi = 3.14159265358979323846;

// P(|X| <= t) for Student's distribution: Abramowitz, Stegun, "Handbook of mathematical functions", 1964, 26.7.3-4.
double student_central(double t, std::int64_t dof) {
  const double nu = static_cast<double>(dof);
  const double angle = std::atan(t / std::sqrt(nu));
  const double c2 = 1 / (1 + t * t / nu), s = std::sin(angle);
  const bool odd = dof % 2 == 1;
  double term = odd ? std::cos(angle) : 1.0, sum = 0;
  for (std::int64_t k = odd ? 3 : 2; k <= dof; k += 2) {
    sum += term;
    const double d = static_cast<double>(k);
    term *= c2 * (d - 1) / d;
  }
  return odd ? 2 / kPi * (angle + s * sum) : s * sum;
}

// The same quantile from the normal one, same book, 26.7.5: four terms, relative error below 1e-12 from 500 on.
double student95_large(double nu) {
  const double z = 1.959963984540054, z2 = z * z;
  const double g1 = z * (z2 + 1) / 4;
  const double g2 = z * ((5 * z2 + 16) * z2 + 3) / 96;
  const double g3 = z * (((3 * z2 + 19) * z2 + 17) * z2 - 15) / 384;
  const double g4 = z * ((((79 * z2 + 776) * z2 + 1482) * z2 - 1920) * z2 - 945) / 92160;
  return z + (g1 + (g2 + (g3 + g4 / nu) / nu) / nu) / nu;
}

struct Mean {
  double mean = 0, deviations = 0;  // deviations = sum of (w (x - mean))^2
};

// Weights of mean 1; without weights each is exactly 1.
Mean mean_of(std::span<const double> x, std::span<const double> weights = {}) {
  assert(weights.empty() || weights.size() == x.size());
  const double n = static_cast<double>(x.size());
  Sum total, sum, squares;
  for (const double w : weights) total.add(w);
  const auto weight = [&](std::size_t i) { return weights.empty() ? 1.0 : weights[i] / (total.value() / n); };
  for (std::size_t i = 0; i < x.size(); ++i) sum.add(weight(i) * x[i]);
  const double mean = sum.value() / n;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double deviation = weight(i) * (x[i] - mean);
    squares.add(deviation * deviation);
  }
  return {mean, squares.value()};
}

// A point of the line: log n and log RMSE.
struct LogPoint {
  double n = 0, x = 0, y = 0;
};

// Least squares slope; NaN unless there are two different x.
double line_slope(std::span<const LogPoint> points) {
  double x_mean = 0, y_mean = 0;
  for (const LogPoint& p : points) {
    x_mean += p.x;
    y_mean += p.y;
  }
  x_mean /= static_cast<double>(points.size());
  y_mean /= static_cast<double>(points.size());
  double xx = 0, xy = 0;
  for (const LogPoint& p : points) {
    xx += (p.x - x_mean) * (p.x - x_mean);
    xy += (p.x - x_mean) * (p.y - y_mean);
  }
  return xx > 0 ? xy / xx : kNan;
}

// A well mixed function of its argument: the finaliser of splitmix64, Steele, Lea, Flood, "Fast splittable
// pseudorandom number generators", OOPSLA 2014.
std::uint64_t mix(std::uint64_t z) {
  z += 0x9e3779b97f4a7c15u;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return z ^ (z >> 31);
}

// Draw `index` of resample `resample`: a trial in [0, trials), the same for every series.
std::size_t drawn_trial(std::uint64_t resample, std::uint64_t index, std::size_t trials) {
  const std::uint64_t high = mix(mix(resample) ^ index) >> 32;
  return static_cast<std::size_t>((high * trials) >> 32);  // trials < 2^32
}

// The spread (standard deviation) of the slopes of kResamples resamples. A resample in which fewer than two points
// have an error tells nothing and is left out; NaN when fewer than two tell something.
double resampled_spread(std::span<const SlopePoint* const> used, std::size_t trials) {
  std::vector<double> slopes;
  std::vector<std::size_t> drawn(trials);
  std::vector<LogPoint> line;
  for (std::uint64_t b = 0; b < kResamples; ++b) {
    for (std::size_t i = 0; i < trials; ++i) drawn[i] = drawn_trial(b, i, trials);
    line.clear();
    for (const SlopePoint* p : used) {
      double sum = 0;
      for (const std::size_t t : drawn) sum += p->mse[t];
      if (sum > 0) line.push_back({p->n, std::log(p->n), 0.5 * std::log(sum / static_cast<double>(trials))});
    }
    const double slope = line.size() < 2 ? kNan : line_slope(line);
    if (std::isfinite(slope)) slopes.push_back(slope);
  }
  if (slopes.size() < 2) return kNan;
  return std::sqrt(mean_of(slopes).deviations / static_cast<double>(slopes.size() - 1));
}

}  // namespace

double student_t95(std::int64_t dof) {
  assert(dof >= 1);
  if (dof >= 500) return student95_large(static_cast<double>(dof));
  double lo = 1, hi = 13;  // 12.7 at dof = 1 is the largest
  for (int i = 0; i < 60; ++i) {
    const double middle = (lo + hi) / 2;
    (student_central(middle, dof) < 0.95 ? lo : hi) = middle;
  }
  return (lo + hi) / 2;
}

double rms_over_trials(std::span<const double> mse, std::span<const double> weights) {
  return mse.empty() ? kNan : std::sqrt(mean_of(mse, weights).mean);
}

std::optional<Interval> rms_interval(std::span<const double> mse, std::span<const double> weights) {
  if (mse.size() < 2) return std::nullopt;
  const Mean m = mean_of(mse, weights);
  if (!std::isfinite(m.deviations)) return std::nullopt;
  const double rms = std::sqrt(m.mean);
  if (m.deviations == 0) return Interval{rms, rms};
  const double n = static_cast<double>(mse.size());
  // d log(mean) = d mean / mean; half of it for the root.
  const double error_of_log = std::sqrt(m.deviations / (n - 1) / n) / m.mean;
  const double half = 0.5 * student_t95(static_cast<std::int64_t>(mse.size()) - 1) * error_of_log;
  return Interval{rms * std::exp(-half), rms * std::exp(half)};
}

std::optional<Slope> fit_slope(std::span<const SlopePoint> points) {
  std::vector<const SlopePoint*> used;
  std::vector<LogPoint> line;
  for (const SlopePoint& p : points) {
    assert(p.n > 0 && p.mse.size() == points.front().mse.size());
    const double rms = rms_over_trials(p.mse);
    if (!(rms > 0) || !std::isfinite(rms)) continue;
    used.push_back(&p);
    line.push_back({p.n, std::log(p.n), std::log(rms)});
  }
  if (line.empty()) return std::nullopt;
  const double fitted = line_slope(line);
  if (!std::isfinite(fitted)) return std::nullopt;

  Slope result{fitted, std::nullopt, line.front().n, line.front().n, static_cast<int>(line.size())};
  for (const LogPoint& p : line) {
    result.n_min = std::fmin(result.n_min, p.n);
    result.n_max = std::fmax(result.n_max, p.n);
  }
  const std::size_t trials = used.front()->mse.size();
  if (trials >= 2) {
    const double t = static_cast<double>(trials);
    const double half =
        student_t95(static_cast<std::int64_t>(trials) - 1) * std::sqrt(t / (t - 1)) * resampled_spread(used, trials);
    if (std::isfinite(half)) result.interval = Interval{fitted - half, fitted + half};
  }
  return result;
}

void TrialMoments::add(std::span<const double> errors) {
  assert(errors.size() == mean_.size());
  ++trials_;
  const double t = static_cast<double>(trials_);
  for (std::size_t i = 0; i < errors.size(); ++i) {
    const double from_old = errors[i] - mean_[i];
    mean_[i] += from_old / t;
    m2_[i] += from_old * (errors[i] - mean_[i]);
  }
}

Split TrialMoments::split(std::int64_t n_pixels) const {
  assert(n_pixels >= static_cast<std::int64_t>(mean_.size()));
  std::int64_t left_out = 0;
  Sum mean_squared, deviations;
  for (std::size_t i = 0; i < mean_.size(); ++i) {
    if (!std::isfinite(m2_[i]) || !std::isfinite(mean_[i])) {
      ++left_out;
      continue;
    }
    mean_squared.add(mean_[i] * mean_[i]);
    deviations.add(m2_[i]);
  }
  const double n = static_cast<double>(n_pixels - left_out), t = static_cast<double>(trials_);
  Split s;
  s.trials = trials_;
  s.mse = s.variance = s.bias_sq = kNan;
  if (trials_ == 0 || n == 0) return s;
  s.mse = (mean_squared.value() + deviations.value() / t) / n;
  if (trials_ == 1) return s;
  s.variance = deviations.value() / (t - 1) / n;
  s.bias_sq = mean_squared.value() / n - s.variance / t;
  return s;
}

Ratio ratio_of_sums(std::span<const double> above, std::span<const double> below) {
  assert(above.size() == below.size());
  const double a = std::accumulate(above.begin(), above.end(), 0.0),
               b = std::accumulate(below.begin(), below.end(), 0.0);
  Ratio ratio{a / b, std::nullopt};
  const auto n = static_cast<std::int64_t>(above.size());
  if (n < 2 || !std::isfinite(ratio.value)) return ratio;
  double squares = 0;
  for (std::size_t i = 0; i < above.size(); ++i) {
    const double off = above[i] - ratio.value * below[i];
    squares += off * off;
  }
  const double count = static_cast<double>(n), error = std::sqrt(squares * count / (count - 1)) / b;
  ratio.interval = {ratio.value - student_t95(n - 1) * error, ratio.value + student_t95(n - 1) * error};
  return ratio;
}

}  // namespace moire
