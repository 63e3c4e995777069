// How many independent numbers a mean of noise power holds.
#include "measure/noise_envelope.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>

#include "core/sum.h"
#include "measure/dft.h"

namespace moire {
namespace {

// How often each column of a half spectrum stands in the whole.
double times(int column, int width) { return column == 0 || 2 * column == width ? 1.0 : 2.0; }

// Over the largest: the scale of errors does not matter here, and squares of powers of small ones would underflow.
std::vector<double> scaled(std::span<const double> values) {
  std::vector<double> out(values.begin(), values.end());
  const double largest = *std::max_element(out.begin(), out.end());
  if (!(largest > 0)) return out;
  for (double& v : out) v /= largest;
  return out;
}

// The whole of a real array that is even, from the half that the transform of an even array has.
std::vector<double> squared_whole(std::span<const std::complex<double>> half, int width, int height) {
  std::vector<double> whole;
  whole.reserve(static_cast<std::size_t>(std::int64_t{width} * height));
  const int columns = dft_columns(width);
  for (int l = 0; l < height; ++l) {
    for (int k = 0; k < width; ++k) {
      const bool here = k < columns;
      const int row = here ? l : (height - l) % height, column = here ? k : width - k;
      whole.push_back(std::norm(half[static_cast<std::size_t>(std::int64_t{row} * columns + column)]));
    }
  }
  return whole;
}

}  // namespace

NoiseEnvelope::NoiseEnvelope(const Spectra& spectra) : width_(spectra.width), height_(spectra.height) {
  assert(spectra.has_split());
  transform_squared_ = squared_whole(real_dft(scaled(spectra.energy), width_, height_), width_, height_);
  const double pixels = static_cast<double>(spectra.energy.size());
  // The correlation of e is the transform of |E|^2, which is real and even, over the number of pixels.
  for (const auto& c : real_dft(transform_squared_, width_, height_))
    correlation_.push_back(std::max(0.0, c.real() / pixels));  // no energy is negative, and no correlation of them

  // A sample variance s^2 of T trials of Gaussian noise has E s^4 = (T + 1) / (T - 1) sigma^4. So the sum of s^4, which
  // is the correlation at distance 0, comes out too large, and by the same difference every |E|^2.
  const double too_large = 2 / (static_cast<double>(spectra.trials) + 1) * correlation_[0];
  correlation_[0] -= too_large;
  for (double& squared : transform_squared_) squared -= too_large;
  sum_squared_ = transform_squared_[0];
}

double NoiseEnvelope::transform_squared(int d_column, int d_row) const {
  const int k = d_column < 0 ? d_column + width_ : d_column, l = d_row < 0 ? d_row + height_ : d_row;
  return transform_squared_[static_cast<std::size_t>(std::int64_t{l} * width_ + k)];
}

double NoiseEnvelope::degrees(std::span<const double> weights_of_any_size) const {
  const std::vector<double> weights = scaled(weights_of_any_size);
  Sum sum, squares, variance;
  for (const double a : weights) {
    sum.add(a);
    squares.add(a * a);
  }
  if (!(squares.value() > 0) || !(sum_squared_ > 0)) return 0;
  // Parseval turns the sum over pairs of bins into one over distances of pixels.
  const std::vector<std::complex<double>> a = real_dft(weights, width_, height_);
  const int columns = dft_columns(width_);
  for (std::size_t i = 0; i < a.size(); ++i)
    variance.add(times(static_cast<int>(i % static_cast<std::size_t>(columns)), width_) * std::norm(a[i]) *
                 correlation_[i]);
  const double squared = sum.value() * sum.value();
  const double most = squared / squares.value();
  return std::clamp(squared * sum_squared_ / variance.value(), std::min(1.0, most), most);
}

double NoiseEnvelope::degrees_of_set(std::span<const std::size_t> bins) const {
  if (bins.empty() || !(sum_squared_ > 0)) return 0;
  // The sum over all pairs of bins from one of each conjugate pair, k and l: k - l, -k + l, k + l and -k - l. A bin
  // that is its own conjugate counts half, since k and -k are then the same.
  struct Bin {
    int k, l;
    double count;
  };
  std::vector<Bin> half;
  Spectra lattice;  // knows which bins are conjugates
  lattice.width = width_;
  lattice.height = height_;
  for (const std::size_t i : bins) {
    const int column = static_cast<int>(i % static_cast<std::size_t>(width_));
    const int row = static_cast<int>(i / static_cast<std::size_t>(width_));
    if (!lattice.is_first(column, row)) continue;
    const int k = column - width_ / 2, l = row - height_ / 2;
    const bool own = 2 * k % width_ == 0 && 2 * l % height_ == 0;
    half.push_back({k, l, own ? 0.5 : 1.0});
  }
  double sum = 0;
  for (std::size_t a = 0; a < half.size(); ++a) {
    double others = 0;
    for (std::size_t b = 0; b < a; ++b) {
      others += half[b].count * (transform_squared(half[a].k - half[b].k, half[a].l - half[b].l) +
                                 transform_squared(half[a].k + half[b].k, half[a].l + half[b].l));
    }
    const double self = half[a].count * (sum_squared_ + transform_squared(2 * half[a].k, 2 * half[a].l));
    sum += 2 * half[a].count * (2 * others + self);
  }
  const double n = static_cast<double>(bins.size());
  return std::clamp(n * n * sum_squared_ / sum, 1.0, n);
}

double NoiseEnvelope::impropriety(int column, int row) const {
  if (!(sum_squared_ > 0)) return 0;
  const double squared = transform_squared(2 * (column - width_ / 2), 2 * (row - height_ / 2));
  return std::sqrt(std::clamp(squared / sum_squared_, 0.0, 1.0));
}

}  // namespace moire
