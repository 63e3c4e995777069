#include "testimages/radial_taylor.h"

#include <cmath>

#include "core/rounding.h"
#include "curve/quadrature.h"
#include "testimages/chebyshev_family.h"

namespace moire {
namespace {

constexpr double kSlack = 1 + 0x1p-20;

}  // namespace

RadialTaylor::RadialTaylor(const PieceWeight& piece, std::size_t count)
    : count_(count),
      size_(piece.series.size()),
      mid_(0.5 * (piece.low + piece.high)),
      half_(0.5 * (piece.high - piece.low)),
      inverse_half_(1 / half_),
      c_(count * size_),
      lost_(count) {
  const auto n = static_cast<double>(size_);
  // Of the place in the piece, in u: r, right to 2 u; its difference to the middle and the factor.
  const double place_error = 8 + 4 * piece.high * inverse_half_;
  std::vector<double> series(piece.series.begin(), piece.series.end()), size(size_), slope(size_), next(size_);
  for (std::size_t i = 0; i < size_; ++i) size[i] = std::fabs(series[i]);
  for (std::size_t k = 0; k < count; ++k) {
    derive(size.data(), size_, slope.data());
    // Coefficients: sums of at most n / 2 terms and their factors, at every step. Clenshaw's b_i is at most the sum
    // over i' >= i of (i' - i + 1) |c_i'|, and takes three operations on numbers of at most twice that size.
    for (std::size_t i = 0; i < size_; ++i) {
      const auto order = static_cast<double>(i);
      const double steps = static_cast<double>(k) * (n + 8) + (size_ > 1 ? 3 * (order + 1) * (order + 2) : 0);
      lost_[k] += kUnit * (steps * size[i] + place_error * slope[i]) * kSlack;
      c_[i * count + k] = series[i];
    }
    const double factor = inverse_half_ / static_cast<double>(k + 1);
    derive(series.data(), size_, next.data());
    for (std::size_t i = 0; i < size_; ++i) {
      series[i] = next[i] * factor;
      size[i] = slope[i] * factor;
    }
  }
}

void RadialTaylor::at(double r, std::size_t n, double* out) const {
  clenshaw(c_.data(), size_, count_, n, (r - mid_) * inverse_half_, out);
}

std::vector<double> RadialTaylor::bounds(double beyond) const {
  const double rho = ellipse_of_disk(beyond * inverse_half_);
  std::vector<double> out(count_);
  double power = 1;
  for (std::size_t i = 0; i < size_; ++i, power *= rho)
    for (std::size_t k = 0; k < count_; ++k) out[k] += std::fabs(c_[i * count_ + k]) * power;
  for (std::size_t k = 0; k < count_; ++k) out[k] = (out[k] + lost_[k] * power) * kSlack;
  return out;
}

}  // namespace moire
