// The spectrum of point sets: which frequencies a sampler's points contain. Exact sums at integer frequencies, no
// binning of points. M. S. Bartlett, "The spectral analysis of two-dimensional point processes", Biometrika 51, 1964;
// R. A. Ulichney, "Dithering with blue noise", Proceedings of the IEEE 76(1), 1988 (rings).
//
// N points on the unit torus have at the integer frequencies m (along x) and n (along y), in cycles per side of the
// torus, the power
//
//   P(m, n) = |sum_j exp(-2 pi i (m x_j + n y_j))|^2 / N,
//
// which is N at zero and for independent uniform points has mean 1 everywhere else. Coincident points count as often as
// they occur. P(-m, -n) = P(m, n).
//
// Accuracy: every term is within 16 * 2^-53 of its value, because the fraction of m x_j is taken without error, and
// sums go on with the rounding errors of their blocks of 128 points. So |sum| is within e N for any N, e = 2e-14, and P
// within 2 e sqrt(P N) + e^2 N: within 4e-14 N at worst, and 0 comes out below 4e-28 N.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "measure/statistics.h"

namespace moire {

// Frequencies along each axis; even.
inline constexpr int kMinFrequencies = 4, kMaxFrequencies = 4096;

// The frequencies that show a set of `points` points: the smallest power of two that is at least 8 sqrt(points), from
// 64 to 1024, so that there are rings up to 4 times the frequency sqrt(points) of a square grid: 512 for 1,600 points.
int usual_frequencies(std::int64_t points);

// The mean of the power of several sets, which may have different numbers of points, over F x F frequencies
// -F/2 <= m, n < F/2. The same bits for any number of threads.
class PointSpectrum {
 public:
  // F is even, kMinFrequencies to kMaxFrequencies.
  explicit PointSpectrum(int frequencies);

  // One set: x and y have the same length, at least 1, and all values lie in [0, 1). Time about points * F^2 * 1.5e-10
  // s on one core, in parallel over points and frequencies.
  void add(std::span<const double> x, std::span<const double> y);

  int frequencies() const noexcept { return frequencies_; }
  std::int64_t sets() const noexcept { return sets_; }
  // F x F, row-major: element (n + F/2) * F + m + F/2 is the sum over sets of P(m, n), divided by the number of sets.
  // Zero frequency has column and row F/2. At least one set.
  std::vector<double> power() const;

 private:
  int frequencies_;
  std::int64_t sets_ = 0;
  std::vector<double> half_;  // sums over sets, m = 0..F/2 by n = -F/2..F/2
};

// Power below this times N is none at all: rounding of coordinates to doubles alone turns phases by up to 10^-12 at the
// highest frequencies.
inline constexpr double kNoPower = 1e-24;

// One ring of integer frequencies (measure/radial.h), k - 1/2 <= |(m, n)| < k + 1/2.
struct RadialPower {
  int frequency = 0;  // k, in cycles per side of the torus
  std::int64_t bins = 0;
  std::int64_t degrees = 0;  // of freedom: bins times sets
  double power = 0;          // mean over bins and sets
  // 95% interval of the true mean, when sums over points are Gaussian numbers and sets are independent: exact in the
  // limit of many points for random ones, an approximation for other random sets, and nothing for fixed points.
  Interval band;
  // Ring::anisotropy_db of the mean over sets: about -10 log10(sets) for isotropic ones; NaN where there is no power.
  double anisotropy_db = 0;
};

// The complete rings, 1 to F/2 - 1, from power() over `sets` sets. Zero frequency belongs to none.
std::vector<RadialPower> radial_power(std::span<const double> power, int frequencies, std::int64_t sets);

// The expected power of one point in each cell of a cells x cells grid, uniform in a square of side `amount` / cells in
// the middle of the cell, amount in [0, 1], cells >= 1: with s = sinc(amount m / cells) sinc(amount n / cells), sinc(x)
// = sin(pi x) / (pi x), it is 1 - s^2, and N s^2 more where cells divides m and n both (N = cells^2). Amount 0 is the
// regular grid.
double jittered_power(int cells, double amount, int m, int n);

}  // namespace moire
