// Fitting Chebyshev series to a kernel's pieces. All of it in double-double until the coefficients are rounded, so that
// the errors of the fitted k are just two:
//  - truncation: interpolation in n + 1 Chebyshev points misses a function bounded by M on the ellipse rho by at most
//    4 M rho^-n / (rho - 1) (Trefethen, "Approximation Theory and Approximation Practice", 2013, thm 8.2); zero for
//    polynomials of degree n;
//  - rounding of the coefficients to double: u = 2^-53 times their absolute sum.
#include "filters/kernel.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

#include "core/dd_math.h"
#include "core/double_double.h"
#include "core/rounding.h"

namespace moire {
namespace {

constexpr int kMaxDegree = 40;

// Smallest degree whose truncation error is at most `tolerance` on every piece, and that error.
struct Truncation {
  int degree;
  double error;
};

Truncation choose_degree(const KernelShape& s, double tolerance) {
  Truncation worst{1, 0};
  for (int piece = 0; piece + 1 < static_cast<int>(s.knots.size()); ++piece) {
    Truncation best{kMaxDegree, HUGE_VAL};
    for (const double rho : {1.5, 2.0, 3.0, 4.0, 6.0, 8.0, 12.0, 16.0, 24.0, 32.0}) {
      const double m = s.ellipse_bound(piece, rho);
      if (!std::isfinite(m)) continue;
      for (int n = 1; n <= kMaxDegree; ++n) {
        const double error = 4 * m * std::pow(rho, -n) / (rho - 1);
        if (error > tolerance && n < kMaxDegree) continue;
        if (n < best.degree || (n == best.degree && error < best.error)) best = {n, error};
        break;
      }
    }
    worst.degree = std::max(worst.degree, best.degree);
    worst.error = std::max(worst.error, best.error);
  }
  return worst;
}

// Chebyshev coefficients c_0..c_n of the interpolant of f in n + 1 Chebyshev points of the first kind on [-1, 1].
std::vector<Dd> interpolate(const std::function<Dd(Dd)>& f, int n) {
  const int m = n + 1;
  std::vector<Dd> c(static_cast<std::size_t>(m));
  for (int i = 0; i < m; ++i) {
    const Dd value = f(dd_cos_pi(2 * i + 1, 2 * m));
    for (int j = 0; j <= n; ++j) {
      // cos(j pi (2i + 1) / 2m), the angle folded into [0, pi].
      int angle = (j * (2 * i + 1)) % (4 * m);
      if (angle > 2 * m) angle = 4 * m - angle;
      const Dd weight = Dd(j == 0 ? 1.0 : 2.0) / Dd(m);
      auto& cj = c[static_cast<std::size_t>(j)];
      cj = cj + value * dd_cos_pi(angle, 2 * m) * weight;
    }
  }
  return c;
}

// Drops the last terms of all pieces while their absolute sum, which bounds what is lost, stays within `tolerance`.
void chop(std::vector<std::vector<Dd>>& series, Truncation& truncation, double tolerance) {
  const auto lost_below = [&](std::size_t terms) {
    double worst = 0;
    for (const auto& c : series) {
      double sum = 0;
      for (std::size_t j = c.size(); j-- > terms;) sum += std::fabs(c[j].hi);
      worst = std::max(worst, sum);
    }
    return worst;
  };
  std::size_t terms = series.front().size();
  while (terms > 2 && lost_below(terms - 1) <= tolerance) --terms;
  truncation.error += lost_below(terms);
  truncation.degree = static_cast<int>(terms) - 1;
  for (auto& c : series) c.resize(terms);
}

// Sum of |c_j| rho^j: a bound on the series over the ellipse rho, since |T_j| <= rho^j there.
double absolute_sum(std::span<const double> c, double rho) {
  double sum = 0;
  for (std::size_t j = c.size(); j-- > 0;) sum = sum * rho + std::fabs(c[j]);
  return sum;
}

// Largest |p| on [-1, 1] of the polynomial p with coefficients c, and the rounding error of its evaluation there.
struct SeriesBound {
  double top = 0, rounding = 0;
};

// p(cos theta) is a trigonometric polynomial of degree n - 1, and the angles are pi / (16 n) apart, so that between
// them it exceeds its largest value on them by at most 1 / cos(pi / 32) (Ehlich and Zeller, "Schwankung von Polynomen
// zwischen Gitterpunkten", Mathematische Zeitschrift 86, 1964). Another bound is the sum of |c_j|. The same holds for
// every b_j of Clenshaw's recurrence b_j = c_j + (2 t b_{j+1} - b_{j+2}). An error in b_j acts as one in c_j: it
// reaches the result times |T_j| <= 1. So the result errs by at most u times the sum over the steps of product,
// difference and sum. All that for |t| <= 1; at 1 + beyond every polynomial of degree n, the T_j among them, is at most
// T_n(1 + beyond) = cosh(n arcosh(1 + beyond)) times larger.
SeriesBound bound_series(std::span<const double> c, double beyond) {
  const std::size_t n = c.size();
  struct Step {
    double product = 0, difference = 0, sum = 0;
  };
  std::vector<Step> steps(n);
  const std::size_t angles = 16 * n;
  for (std::size_t i = 0; i < angles; ++i) {
    const double t = std::cos(std::numbers::pi * (2 * static_cast<double>(i) + 1) / (2 * static_cast<double>(angles)));
    double b1 = 0, b2 = 0;
    for (std::size_t j = n; j-- > 0;) {
      const double product = (j > 0 ? 2 * t : t) * b1, difference = product - b2, b = c[j] + difference;
      Step& s = steps[j];
      s = {std::max(s.product, std::fabs(product)), std::max(s.difference, std::fabs(difference)),
           std::max(s.sum, std::fabs(b))};
      b2 = b1;
      b1 = b;
    }
  }
  // 2^-20 for the rounding of all this and for points beyond ordinary pieces' ends; very short ones get twice the need.
  const double growth = std::cosh(static_cast<double>(n - 1) * std::acosh(1 + beyond));
  const double room = 1 + std::max(0x1p-20, 2 * (growth * growth - 1));
  const double between = 1.0048387 * room;
  SeriesBound bound;
  // The first step, b_{n-1} = c_{n-1}, is exact.
  for (std::size_t j = 0; j + 1 < n; ++j) {
    bound.rounding += kUnit * between * (steps[j].product + steps[j].difference + steps[j].sum);
  }
  bound.top = std::min(between * steps[0].sum + bound.rounding, absolute_sum(c, 1) * room);
  return bound;
}

// Coefficients of the derivative with respect to t.
std::vector<double> derivative(std::span<const double> c) {
  std::vector<double> d(c.size() + 1, 0.0);
  for (std::size_t j = c.size(); j-- > 1;) d[j - 1] = d[j + 1] + 2 * static_cast<double>(j) * c[j];
  d[0] *= 0.5;
  d.resize(std::max<std::size_t>(c.size() - 1, 1));
  return d;
}

}  // namespace

Kernel::Kernel(const KernelShape& s) : knots_(s.knots) {
  assert(knots_.size() >= 2 && knots_.front() == -knots_.back());
  double peak = 0;
  for (int p = 0; p < pieces(); ++p) {
    const auto i = static_cast<std::size_t>(p);
    for (int j = 0; j <= 8; ++j) {
      peak = std::max(peak, std::fabs(s.shape(p, knots_[i] + (knots_[i + 1] - knots_[i]) * j / 8).hi));
    }
  }
  Truncation truncation = s.degree < 0 ? choose_degree(s, peak * 0x1p-60) : Truncation{s.degree, 0};
  std::vector<std::vector<Dd>> k_series;
  std::vector<Dd> middle, half_length;
  for (int p = 0; p < pieces(); ++p) {
    const Dd left = knots_[static_cast<std::size_t>(p)], right = knots_[static_cast<std::size_t>(p) + 1];
    middle.push_back(Dd(0.5) * (left + right));
    half_length.push_back(Dd(0.5) * (right - left));
    k_series.push_back(
        interpolate([&](Dd t) { return s.shape(p, middle.back() + half_length.back() * t); }, truncation.degree));
  }
  if (s.degree < 0) chop(k_series, truncation, peak * kUnit / 16);
  degree_ = truncation.degree;

  // Series in double-double, integrated piece by piece; C_j of the antiderivative from c_{j-1} - c_{j+1}.
  const auto terms = static_cast<std::size_t>(degree_ + 1);
  std::vector<std::vector<Dd>> K_series;
  Dd total = 0.0;
  for (std::size_t p = 0; p < k_series.size(); ++p) {
    const std::vector<Dd>& c = k_series[p];
    const Dd half = half_length[p];
    std::vector<Dd> big(terms + 1);
    const auto at = [&](std::size_t j) { return j < terms ? c[j] : Dd(0.0); };
    big[1] = half * (at(0) - at(2) * Dd(0.5));
    for (std::size_t j = 2; j <= terms; ++j) big[j] = half * (at(j - 1) - at(j + 1)) / Dd(2.0 * static_cast<double>(j));
    Dd at_left = 0.0, at_right = 0.0;  // T_j(-1) = (-1)^j, T_j(1) = 1
    for (std::size_t j = 1; j <= terms; ++j) {
      at_left = at_left + (j % 2 == 0 ? big[j] : -big[j]);
      at_right = at_right + big[j];
    }
    big[0] = total - at_left;
    total = big[0] + at_right;
    pieces_.push_back({middle[p].value(), half.value(), 1 / half.value(), 0, 0});
    K_series.push_back(std::move(big));
  }

  integral_ = total.value();
  // Coefficients are rounded once; what that changes at most, |T_j| being at most 1. The arithmetic before, some
  // hundred steps of 2^-104 each, stays below 2^-90.
  const auto append = [&](const std::vector<Dd>& series) {
    double lost = 0;
    for (const Dd c : series) {
      const Dd share = c / total;
      coefficients_.push_back(share.value());
      lost += std::fabs((share - Dd(coefficients_.back())).hi) + 0x1p-90 * std::fabs(share.hi);
    }
    return lost;
  };
  // Shapes are right to 2^-80 of their peak (filter.h), which interpolation in at most 41 points enlarges by less than
  // 3.4, its Lebesgue constant; with room for a peak between the points looked at.
  const double fit = (truncation.error + 0x1p-77 * peak) / std::fabs(integral_);
  // The integral errs by at most support * truncation: dividing by it changes k and K by that share of themselves.
  const double support = 2 * radius();
  const double normalised = support * fit;
  bounds_.resize(pieces_.size() + 2);
  bounds_.back().K = 1;
  for (std::size_t i = 0; i < pieces_.size(); ++i) {
    Piece& p = pieces_[i];
    PieceBounds& bound = bounds_[i + 1];
    p.k_first = coefficients_.size();
    const double lost_k = append(k_series[i]);
    p.K_first = coefficients_.size();
    const double lost_K = append(K_series[i]);
    const std::span<const double> c(coefficients_.data() + p.k_first, terms);
    const std::span<const double> big(coefficients_.data() + p.K_first, terms + 1);
    const double beyond = kBeyond * radius() / p.half;  // in t
    const SeriesBound k = bound_series(c, beyond), K = bound_series(big, beyond);
    bound.k = k.top;
    bound.K = K.top;
    bound.slope = bound_series(derivative(c), beyond).top / p.half;
    bound.k_error = fit + k.top * normalised + lost_k + k.rounding;
    bound.K_error = support * fit + K.top * normalised + lost_K + K.rounding;
    // t = (x - mid) * inverse_half: a difference and a product, besides the rounding of mid and of inverse_half.
    const double middle_error = std::fabs((middle[i] - Dd(p.mid)).hi);
    const double scale_error = std::fabs((half_length[i] * Dd(p.inverse_half) - Dd(1.0)).hi);
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

double Kernel::evaluate(std::size_t first, int degree, double t) const noexcept {
  const double* c = coefficients_.data() + first;
  double b1 = 0, b2 = 0;
  const double t2 = t + t;
  for (int j = degree; j >= 1; --j) {
    const double b = c[j] + (t2 * b1 - b2);
    b2 = b1;
    b1 = b;
  }
  return c[0] + (t * b1 - b2);
}

// Blocks of four, so that the compiler makes vectors of the inner loops and the recurrences of four points overlap.
void Kernel::evaluate(std::size_t first, int degree, std::span<const double> t, double* out) const noexcept {
  constexpr std::size_t kLanes = 4;
  const double* c = coefficients_.data() + first;
  std::size_t i = 0;
  for (; i + kLanes <= t.size(); i += kLanes) {
    double b1[kLanes] = {}, b2[kLanes] = {}, t2[kLanes];
    for (std::size_t l = 0; l < kLanes; ++l) t2[l] = t[i + l] + t[i + l];
    for (int j = degree; j >= 1; --j) {
      for (std::size_t l = 0; l < kLanes; ++l) {
        const double b = c[j] + (t2[l] * b1[l] - b2[l]);
        b2[l] = b1[l];
        b1[l] = b;
      }
    }
    for (std::size_t l = 0; l < kLanes; ++l) out[i + l] = c[0] + (t[i + l] * b1[l] - b2[l]);
  }
  for (; i < t.size(); ++i) out[i] = evaluate(first, degree, t[i]);
}

void Kernel::k_at(int piece, std::span<const double> t, double* out) const noexcept {
  evaluate(pieces_[static_cast<std::size_t>(piece)].k_first, degree_, t, out);
}

void Kernel::K_at(int piece, std::span<const double> t, double* out) const noexcept {
  evaluate(pieces_[static_cast<std::size_t>(piece)].K_first, degree_ + 1, t, out);
}

int Kernel::piece_of(double x) const noexcept {
  return static_cast<int>(std::upper_bound(knots_.begin(), knots_.end(), x) - knots_.begin()) - 1;
}

bool Kernel::near_knot(int piece, double x, double distance) const noexcept {
  const auto i = static_cast<std::size_t>(piece + 1);
  return (piece >= 0 && std::fabs(x - knots_[i - 1]) <= distance) ||
         (piece < pieces() && std::fabs(x - knots_[i]) <= distance);
}

double Kernel::k_piece(int piece, double x) const noexcept {
  const Piece& p = pieces_[static_cast<std::size_t>(piece)];
  return evaluate(p.k_first, degree_, (x - p.mid) * p.inverse_half);
}

double Kernel::K_piece(int piece, double x) const noexcept {
  const Piece& p = pieces_[static_cast<std::size_t>(piece)];
  return evaluate(p.K_first, degree_ + 1, (x - p.mid) * p.inverse_half);
}

double Kernel::k_on_ellipse(int piece, double rho) const noexcept {
  const Piece& p = pieces_[static_cast<std::size_t>(piece)];
  return absolute_sum({coefficients_.data() + p.k_first, static_cast<std::size_t>(degree_) + 1}, rho);
}

double Kernel::K_on_ellipse(int piece, double rho) const noexcept {
  const Piece& p = pieces_[static_cast<std::size_t>(piece)];
  return absolute_sum({coefficients_.data() + p.K_first, static_cast<std::size_t>(degree_) + 2}, rho);
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
