// A kernel made of its shape: the fitted pieces, integrated, divided by their integral and rounded, with bounds.
#include "filters/kernel.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "core/double_double.h"
#include "core/rounding.h"
#include "filters/chebyshev_series.h"

namespace moire {

Kernel::Kernel(const KernelShape& s) : knots_(s.knots) {
  assert(knots_.size() >= 2 && knots_.front() == -knots_.back());
  const ShapeFit fit = fit_shape(s);
  degree_ = fit.degree;

  // Series in double-double, integrated piece by piece.
  const auto terms = static_cast<std::size_t>(degree_ + 1);
  std::vector<std::vector<Dd>> K_series;
  Dd total = 0.0;
  for (std::size_t p = 0; p < fit.series.size(); ++p) {
    const Dd half = fit.half_length[p];
    pieces_.push_back({fit.middle[p].value(), half.value(), 1 / half.value(), 0, 0});
    K_series.push_back(antiderivative(fit.series[p], half, total));
  }

  integral_ = total.value();
  const double fit_error = fit.error / std::fabs(integral_);
  // The integral errs by at most support * fit_error: dividing by it changes k and K by that share of themselves.
  const double support = 2 * radius();
  const double normalised = support * fit_error;
  bounds_.resize(pieces_.size() + 2);
  bounds_.back().K = 1;
  for (std::size_t i = 0; i < pieces_.size(); ++i) {
    SeriesPiece& p = pieces_[i];
    PieceBounds& bound = bounds_[i + 1];
    p.k_first = coefficients_.size();
    const double lost_k = append_rounded(fit.series[i], total, coefficients_);
    p.integral_first = coefficients_.size();
    const double lost_K = append_rounded(K_series[i], total, coefficients_);
    const std::span<const double> c(coefficients_.data() + p.k_first, terms);
    const std::span<const double> big(coefficients_.data() + p.integral_first, terms + 1);
    const double beyond = kBeyond * radius() / p.half;  // in t
    const SeriesBound k = bound_series(c, beyond), K = bound_series(big, beyond);
    bound.k = k.top;
    bound.K = K.top;
    bound.slope = bound_series(derivative(c), beyond).top / p.half;
    bound.k_error = fit_error + k.top * normalised + lost_k + k.rounding;
    bound.K_error = support * fit_error + K.top * normalised + lost_K + K.rounding;
    // t = (x - mid) * inverse_half: a difference and a product, besides the rounding of mid and of inverse_half.
    const double middle_error = std::fabs((fit.middle[i] - Dd(p.mid)).hi);
    const double scale_error = std::fabs((fit.half_length[i] * Dd(p.inverse_half) - Dd(1.0)).hi);
    bound.t_error = (2 * kUnit + scale_error) * (1 + std::max(0x1p-40, 2 * beyond)) + 1.01 * middle_error / p.half;
    bound.k_error_at_x = bound.k_error + bound.t_error * p.half * bound.slope;
    bound.K_error_at_x = bound.K_error + bound.t_error * p.half * bound.k;
    k_max_ = std::max(k_max_, bound.k);
    K_max_ = std::max(K_max_, bound.K);
    slope_max_ = std::max(slope_max_, bound.slope);
    k_error_ = std::max(k_error_, bound.k_error_at_x);
    K_error_ = std::max(K_error_, bound.K_error_at_x);
  }
  // Room for the rounding of whoever checks this in 64 bits.
  k_error_ += 0x1p-60 * k_max_;
  K_error_ += 0x1p-60 * K_max_;
  for (int p = 0; p <= pieces(); ++p) {
    const double knot = knots_[static_cast<std::size_t>(p)];
    const double left = p > 0 ? k_piece(p - 1, knot) : 0, right = p < pieces() ? k_piece(p, knot) : 0;
    const double jump = std::fabs(left - right);
    const auto i = static_cast<std::size_t>(p);
    for (PieceBounds* bound : {&bounds_[i], &bounds_[i + 1]}) bound->jump = std::max(bound->jump, jump);
    jump_max_ = std::max(jump_max_, jump);
  }
  unit_box_ = degree_ == 0 && pieces() == 1 && radius() == 0.5 && coefficients_[0] == 1.0;
}

void Kernel::k_at(int piece, std::span<const double> t, double* out) const noexcept {
  chebyshev_sums(coefficients_.data() + pieces_[static_cast<std::size_t>(piece)].k_first, degree_, t, out);
}

void Kernel::K_at(int piece, std::span<const double> t, double* out) const noexcept {
  chebyshev_sums(coefficients_.data() + pieces_[static_cast<std::size_t>(piece)].integral_first, degree_ + 1, t, out);
}

bool Kernel::near_knot(int piece, double x, double distance) const noexcept {
  const auto i = static_cast<std::size_t>(piece + 1);
  return (piece >= 0 && std::fabs(x - knots_[i - 1]) <= distance) ||
         (piece < pieces() && std::fabs(x - knots_[i]) <= distance);
}

double Kernel::k_piece(int piece, double x) const noexcept {
  const SeriesPiece& p = pieces_[static_cast<std::size_t>(piece)];
  return chebyshev_sum(coefficients_.data() + p.k_first, degree_, (x - p.mid) * p.inverse_half);
}

double Kernel::K_piece(int piece, double x) const noexcept {
  const SeriesPiece& p = pieces_[static_cast<std::size_t>(piece)];
  return chebyshev_sum(coefficients_.data() + p.integral_first, degree_ + 1, (x - p.mid) * p.inverse_half);
}

double Kernel::k_on_ellipse(int piece, double rho) const noexcept {
  const SeriesPiece& p = pieces_[static_cast<std::size_t>(piece)];
  return absolute_sum({coefficients_.data() + p.k_first, static_cast<std::size_t>(degree_) + 1}, rho);
}

double Kernel::K_on_ellipse(int piece, double rho) const noexcept {
  const SeriesPiece& p = pieces_[static_cast<std::size_t>(piece)];
  return absolute_sum({coefficients_.data() + p.integral_first, static_cast<std::size_t>(degree_) + 2}, rho);
}

double Kernel::k(double x) const noexcept {
  const int p = piece_of(x);
  return p < 0 || p >= pieces() ? 0.0 : k_piece(p, x);
}

double Kernel::K(double x) const noexcept {
  const int p = piece_of(x);
  return x <= knots_.front() ? 0.0 : p >= pieces() ? 1.0 : K_piece(p, x);
}

}  // namespace moire
