// A radial kernel made of its shape: the fitted pieces of k, integrated with the weight r, divided by their integral
// over the plane and rounded, with bounds.
#include "filters/radial_kernel.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "core/dd_math.h"
#include "core/rounding.h"
#include "curve/quadrature.h"
#include "filters/chebyshev_series.h"

namespace moire {
namespace {

// How far beyond its ends a piece is used, in t: what the rounding of t comes to there.
constexpr double kBeyond = 0x1p-48;

// The series of q from that of k on the first piece, r = half (1 + t). r q' + 2 q = k reads, with q = sum a_j T_j and
// dq/dt = sum b_j T_j: (j + 2) a_j + b_j + b_{j+1} = k_j for j > 0, 2 a_0 + b_0 + b_1 / 2 = k_0, where
// b_{j-1} = b_{j+1} + 2 j a_j and b_0 half as much: from the highest term down, and nothing is divided by r.
//
// How it errs: what an equation is missed by is an error of k, and q is the mean of k with the weight 2 s / r^2,
// halved; so q errs by at most half of it. All |b_j| are below 2 degree^2 max |q|, so that in 41 equations of 4
// operations less than 2^-84 max |k| comes together: kSolved.
constexpr double kSolved = 0x1p-80;
std::vector<Dd> mean_series(std::span<const Dd> k) {
  const std::size_t n = k.size() - 1;
  std::vector<Dd> a(n + 1), b(n + 2);
  for (std::size_t j = n; j > 0; --j) {
    const auto order = static_cast<double>(j);
    a[j] = (k[j] - b[j] - b[j + 1]) / Dd(order + 2);
    b[j - 1] = b[j + 1] + Dd(2 * order) * a[j];
  }
  b[0] = Dd(0.5) * b[0];
  a[0] = Dd(0.5) * (k[0] - b[0] - Dd(0.5) * b[1]);
  return a;
}

}  // namespace

RadialKernel::RadialKernel(const KernelShape& s) : knots_(s.knots) {
  assert(knots_.size() >= 2 && knots_.front() == 0);
  for (std::size_t i = 1; i + 1 < knots_.size(); ++i) assert(knots_[i + 1] <= 2 * knots_[i] * (1 + 0x1p-40));
  const ShapeFit fit = fit_shape(s);
  degree_ = fit.degree;

  // G, piece by piece.
  std::vector<std::vector<Dd>> integrals;
  const Dd first_end = Dd(knots_[1]);
  Dd total = 0.0;
  for (std::size_t p = 0; p < fit.series.size(); ++p) {
    const Dd middle = fit.middle[p], half = fit.half_length[p];
    pieces_.push_back({middle.value(), half.value(), 1 / half.value(), 0, 0});
    if (p == 0) {
      integrals.push_back(mean_series(fit.series[0]));
      Dd q_end = 0.0;
      for (const Dd a : integrals[0]) q_end = q_end + a;
      total = q_end * first_end * first_end;
      continue;
    }
    integrals.push_back(antiderivative(times_linear(fit.series[p], middle, half), half, total));
  }
  const Dd whole = Dd(2.0) * kPi * total;
  integral_ = whole.value();

  std::vector<double> lost_k, lost;
  for (std::size_t p = 0; p < pieces_.size(); ++p) {
    pieces_[p].k_first = coefficients_.size();
    lost_k.push_back(append_rounded(fit.series[p], whole, coefficients_));
    pieces_[p].integral_first = coefficients_.size();
    lost.push_back(append_rounded(integrals[p], whole, coefficients_));
  }
  set_bounds(fit, fit.error / std::fabs(integral_), lost_k, lost);
}

// `lost_k`, `lost`: what the rounding of each piece's coefficients changes. An error e of k changes q by at most e / 2,
// and the integral over the plane by pi radius^2 e: dividing by it changes k and q by that share of themselves.
void RadialKernel::set_bounds(const ShapeFit& fit, double fit_error, std::span<const double> lost_k,
                              std::span<const double> lost) {
  const double normalised = std::numbers::pi * radius() * radius() * fit_error * (1 + 0x1p-40);
  bounds_.resize(pieces_.size());
  for (int i = 0; i < pieces(); ++i) {
    const auto at = static_cast<std::size_t>(i);
    const SeriesPiece& p = pieces_[at];
    PieceBounds& bound = bounds_[at];
    const std::span<const double> c(k_coefficients(i), static_cast<std::size_t>(degree_) + 1);
    const std::span<const double> big(integral_series(i), static_cast<std::size_t>(integral_degree(i)) + 1);
    const double left = knots_[at], right = knots_[at + 1];
    const SeriesBound k = bound_series(c, kBeyond), integral = bound_series(big, kBeyond);
    bound.k = k.top;
    k_max_ = std::max(k_max_, bound.k);
    bound.slope = bound_series(derivative(c), kBeyond).top / p.half;
    slope_max_ = std::max(slope_max_, bound.slope);
    // t = (r - mid) * inverse_half: a difference and a product, besides the rounding of mid and of inverse_half.
    const double middle_error = std::fabs((fit.middle[at] - Dd(p.mid)).hi);
    const double scale_error = std::fabs((fit.half_length[at] * Dd(p.inverse_half) - Dd(1.0)).hi);
    const double t_error = (2 * kUnit + scale_error) * (1 + 0x1p-40) + 1.01 * middle_error / p.half;
    bound.k_error = fit_error + k.top * normalised + lost_k[at] + k.rounding + t_error * p.half * bound.slope;
    // q is a mean of k halved; and it is no more than the largest |G| over the smallest r^2.
    const double square = left * left;
    bound.q = 0.5 * k_max_ * (1 + 0x1p-20);  // for the rounded series, too
    double evaluated = lost[at] + integral.rounding;
    if (i == 0) {
      bound.q = std::min(bound.q, integral.top);
      std::vector<double> rest(c.begin(), c.end());  // k - 2 q, which is 0 at r = 0
      for (std::size_t j = 0; j < rest.size(); ++j) rest[j] -= 2 * big[j];
      bound.growth = bound_series(rest, kBeyond).top + 4 * kUnit * k.top;
      evaluated += t_error * bound_series(derivative(big), kBeyond).top + kSolved * k.top;
    } else {
      bound.q = std::min(bound.q, integral.top / square);
      bound.growth = k.top + 2 * bound.q;
      // dG/dr = k r. What G errs by; r r and the quotient add u each of q.
      evaluated =
          (evaluated + t_error * p.half * k.top * right + 0x1p-80 * integral.top) / square + 2.01 * kUnit * bound.q;
    }
    bound.q_error = 0.5 * fit_error + bound.q * normalised + evaluated;
    k_error_ = std::max(k_error_, bound.k_error);
    q_error_ = std::max(q_error_, bound.q_error);
    G_error_ = std::max(G_error_, right * right * (bound.q_error + 2.01 * kUnit * bound.q));
  }
  // Room for the rounding of whoever checks this in 64 bits, and for kWhole beyond the radius.
  k_error_ += 0x1p-60 * k_max_;
  q_error_ += 0x1p-60 * k_max_ + 4 * kUnit * kWhole / (radius() * radius());
  G_error_ += 0x1p-60 * kWhole + kUnit * kWhole;
  // Values of two pieces at one knot, each right to its error: what they differ by less is rounding, but no jump.
  for (int i = 1; i <= pieces(); ++i) {
    const auto at = static_cast<std::size_t>(i);
    const double right = i < pieces() ? k_piece(i, knots_[at]) : 0;
    const double jump = std::fabs(k_piece(i - 1, knots_[at]) - right);
    bounds_[at - 1].jump = std::max(bounds_[at - 1].jump, jump);
    if (i < pieces()) bounds_[at].jump = jump;
    jump_max_ = std::max(jump_max_, jump);
  }
}

double RadialKernel::k_piece(int i, double r) const noexcept {
  const SeriesPiece& p = piece(i);
  return chebyshev_sum(k_coefficients(i), degree_, (r - p.mid) * p.inverse_half);
}

double RadialKernel::q_piece(int i, double r) const noexcept {
  const SeriesPiece& p = piece(i);
  const double value = chebyshev_sum(integral_series(i), integral_degree(i), (r - p.mid) * p.inverse_half);
  return i == 0 ? value : value / (r * r);
}

void RadialKernel::q_pieces(int i, std::span<const double> r, double* out) const noexcept {
  const SeriesPiece& p = piece(i);
  double t[kMaxNodes];
  for (std::size_t first = 0; first < r.size(); first += kMaxNodes) {
    const std::size_t n = std::min<std::size_t>(kMaxNodes, r.size() - first);
    for (std::size_t j = 0; j < n; ++j) t[j] = (r[first + j] - p.mid) * p.inverse_half;
    chebyshev_sums(integral_series(i), integral_degree(i), {t, n}, out + first);
    if (i == 0) continue;
    for (std::size_t j = 0; j < n; ++j) out[first + j] /= r[first + j] * r[first + j];
  }
}

double RadialKernel::k_in_disk(int i, double reach) const noexcept {
  const double rho = ellipse_of_disk(reach / piece(i).half);
  return absolute_sum({k_coefficients(i), static_cast<std::size_t>(degree_) + 1}, rho);
}

double RadialKernel::q_in_disk(int i, double r, double reach) const noexcept {
  const double rho = ellipse_of_disk(reach / piece(i).half);
  const double top = absolute_sum({integral_series(i), static_cast<std::size_t>(integral_degree(i)) + 1}, rho);
  if (i == 0) return top;
  const double nearest = r - reach;
  return nearest > 0 ? top / (nearest * nearest) : HUGE_VAL;
}

double RadialKernel::k(double r) const noexcept {
  const int p = piece_of(r);
  return p < 0 || p >= pieces() ? 0.0 : k_piece(p, r);
}

double RadialKernel::q(double r) const noexcept {
  const int p = std::max(piece_of(r), 0);
  return p >= pieces() ? kWhole / (r * r) : q_piece(p, r);
}

double RadialKernel::G(double r) const noexcept { return r >= radius() ? kWhole : r * r * q(r); }

void RadialKernel::weights(std::span<const double> x, std::span<const double> y, std::span<double> out) const noexcept {
  for (std::size_t i = 0; i < x.size(); ++i) out[i] = std::sqrt(x[i] * x[i] + y[i] * y[i]);
  weights_of({knots_, pieces_, coefficients_.data(), degree_}, out, out);
}

}  // namespace moire
