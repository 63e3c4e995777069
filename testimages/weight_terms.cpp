// Rounding: coefficients carry bounds of their own through the recurrence, which is linear with factors that are not
// negative once their signs are dropped; |T_n| <= 1, so that sums of coefficients and of their errors bound values.
#include "testimages/weight_terms.h"

#include <algorithm>
#include <cmath>

#include "core/rounding.h"
#include "curve/quadrature.h"
#include "testimages/binomials.h"
#include "testimages/chebyshev_family.h"

namespace moire {
namespace {

// Coefficient k of t f(t).
double times_t(const double* f, std::size_t n, std::size_t k) {
  const double above = k + 1 < n ? 0.5 * f[k + 1] : 0;
  return k == 0 ? above : above + (k == 1 ? f[0] : 0.5 * f[k - 1]);
}

}  // namespace

WeightChain::WeightChain(const PieceWeight& piece, Bounded a, Bounded e, int first)
    : size_(piece.series.size()),
      mid_(0.5 * (piece.low + piece.high)),
      inverse_half_(2 / (piece.high - piece.low)),
      c_((kMaxTerms + 1) * size_),
      by_power_(c_.size()) {
  std::copy(piece.series.begin(), piece.series.end(), c_.begin());
  const auto n = static_cast<double>(size_);
  const double unit = kUnit * (n + 8);  // of a coefficient: sums of at most n / 2 + 5 terms, and their factors
  // Of t, in u: the middle and the inverse; the ends of a side and what lies between.
  const double t_error = 8 + 2 * std::fabs(mid_) * inverse_half_;
  std::vector<double> size(size_), error(size_), slope(size_), size_slope(size_), error_slope(size_);
  for (std::size_t k = 0; k <= kMaxTerms; ++k) {
    const double* c = &c_[k * size_];
    for (std::size_t i = 0; i < size_; ++i) size[i] = std::fabs(c[i]);
    derive(c, size_, slope.data());
    derive(size.data(), size_, size_slope.data());
    derive(error.data(), size_, error_slope.data());
    // Clenshaw's b_i is at most the sum over i' >= i of (i' - i + 1) |c_i'|, and takes three operations on numbers of
    // at most twice that size.
    double slope_top = 0, lost = 0;
    for (std::size_t i = 0; i < size_; ++i) {
      const auto order = static_cast<double>(i);
      top_[k] += size[i] + error[i];
      slope_top += size_slope[i] + error_slope[i];
      error_[k] += error[i];
      lost += size[i] * (order + 1) * (order + 2);
    }
    error_[k] = (error_[k] + kUnit * ((size_ > 1 ? 3 * lost : 0) + t_error * slope_top)) * (1 + 0x1p-40);
    top_[k] *= 1 + 0x1p-40;
    if (k == kMaxTerms) break;
    double* next = &c_[(k + 1) * size_];
    const double order = static_cast<double>(k) + first;
    std::vector<double> next_error(size_);
    for (std::size_t i = 0; i < size_; ++i) {
      next[i] = e.value * (order * c[i] + times_t(slope.data(), size_, i)) - a.value * slope[i];
      const double turned = order * size[i] + times_t(size_slope.data(), size_, i);
      const double turned_error = order * error[i] + times_t(error_slope.data(), size_, i);
      next_error[i] = (std::fabs(e.value) + e.error) * (turned_error + unit * turned) + e.error * turned +
                      (std::fabs(a.value) + a.error) * (error_slope[i] + unit * size_slope[i]) +
                      a.error * size_slope[i];
    }
    error.swap(next_error);
  }
  for (std::size_t i = 0; i < size_; ++i)
    for (std::size_t k = 0; k <= kMaxTerms; ++k) by_power_[i * (kMaxTerms + 1) + k] = c_[k * size_ + i];
}

double WeightChain::at(std::size_t k, double t) const { return clenshaw(&c_[k * size_], size_, t); }

void WeightChain::at(double t, std::size_t count, double* out) const {
  clenshaw(by_power_.data(), size_, kMaxTerms + 1, count, t, out);
}

double WeightChain::top_nearby(std::size_t k, double radius) const {
  const double rho = ellipse_of_disk(radius);
  double sum = 0, power = 1;
  for (std::size_t i = 0; i < size_; ++i, power *= rho) sum += std::fabs(c_[k * size_ + i]) * power;
  return (sum + error_[k] * power) * (1 + 0x1p-40);
}

namespace {

Bounded scaled(Bounded x, double factor) {
  return {x.value * factor, (x.error + 2 * kUnit * std::fabs(x.value)) * std::fabs(factor)};
}

}  // namespace

WeightTerms::WeightTerms(const PieceWeight& x, const PieceWeight& y, Bounded a, Bounded b, Bounded e)
    : x_(x, scaled(a, 2 / (x.high - x.low)), e, 1), y_(y, scaled(b, 2 / (y.high - y.low)), e, 2) {
  for (std::size_t j = 0; j <= kMaxTerms; ++j) {
    double error = 0;
    for (std::size_t k = 0; k <= j; ++k) {
      const double times = kBinomials[j][k];
      top_[j] += times * x_.top(k) * y_.top(j - k);
      error += times * (x_.error(k) * y_.top(j - k) + x_.top(k) * y_.error(j - k));
    }
    error_[j] = (error + static_cast<double>(2 * j + 4) * kUnit * top_[j]) * (1 + 0x1p-40);
    top_[j] *= 1 + 0x1p-40;
  }
}

double WeightTerms::top_nearby(int j, double radius) const {
  double top = 0;
  for (std::size_t k = 0, n = static_cast<std::size_t>(j); k <= n; ++k) {
    top += kBinomials[n][k] * x_.top_nearby(k, radius) * y_.top_nearby(n - k, radius);
  }
  return top * (1 + 0x1p-40);
}

WeightTerms::Extent WeightTerms::extent(Vec2 a, Vec2 b) const {
  const double dx = (b.x - a.x) * x_.inverse_half(), dy = (b.y - a.y) * y_.inverse_half();
  const bool upright = dx == 0, oblique = !upright && dy != 0 && x_.degree() > 0;
  return {oblique   ? x_.degree() + y_.degree()
          : upright ? y_.degree()
                    : x_.degree(),
          std::max(std::fabs(dx), std::fabs(dy))};
}

WeightTerms::Along::Along(const WeightTerms& terms, Vec2 a, Vec2 b, int count)
    : terms_(&terms),
      x_(terms.x_.t_of(a.x)),
      dx_((b.x - a.x) * terms.x_.inverse_half()),
      y_(terms.y_.t_of(a.y)),
      dy_((b.y - a.y) * terms.y_.inverse_half()) {
  const auto [degree, extent] = terms.extent(a, b);
  degree_ = degree;
  extent_ = extent;
  const bool upright = dx_ == 0;
  const WeightChain &run = upright ? terms.y_ : terms.x_, &fixed = upright ? terms.x_ : terms.y_;
  if (!upright && dy_ != 0 && run.degree() > 0) return;
  const auto terms_here = static_cast<std::size_t>(count), size = static_cast<std::size_t>(degree_ + 1);
  series_.assign(terms_here * size, 0);
  double at[kMaxTerms + 1];
  for (std::size_t k = 0; k < terms_here; ++k) at[k] = fixed.at(k, upright ? x_ : y_);
  for (std::size_t j = 0; j < terms_here; ++j) {
    for (std::size_t k = 0; k <= j; ++k) {
      const double times = kBinomials[j][k] * at[j - k];
      const std::span<const double> c = run.series(k);
      for (std::size_t i = 0; i < size; ++i) series_[i * terms_here + j] += times * c[i];
    }
  }
}

void WeightTerms::Along::at(double tau, int count, double* g) const {
  const auto n = static_cast<std::size_t>(count);
  if (!series_.empty()) {
    const auto size = static_cast<std::size_t>(degree_ + 1);
    const double t = dx_ == 0 ? y_ + tau * dy_ : x_ + tau * dx_;
    clenshaw(series_.data(), size, series_.size() / size, n, t, g);
    return;
  }
  double p[kMaxTerms + 1], q[kMaxTerms + 1];
  terms_->x_.at(x_ + tau * dx_, n, p);
  terms_->y_.at(y_ + tau * dy_, n, q);
  for (std::size_t j = 0; j < n; ++j) {
    g[j] = 0;
    for (std::size_t k = 0; k <= j; ++k) g[j] += kBinomials[j][k] * p[k] * q[j - k];
  }
}

}  // namespace moire
