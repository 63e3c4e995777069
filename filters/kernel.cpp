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

// Bound on the rounding error of Clenshaw's recurrence b_j = c_j + 2 t b_{j+1} - b_{j+2} for |t| <= 1: step j errs by
// at most u (2 |2 t b_{j+1}| + |b_{j+2}| + 2 |b_j|), which reaches the result times |U_j| <= j + 1.
double clenshaw_error(std::span<const double> c) {
  const std::size_t n = c.size();
  std::vector<double> b(n + 2, 0.0);  // bounds on |b_j|: sum over i >= j of |c_i| (i - j + 1)
  for (std::size_t j = n; j-- > 0;) {
    for (std::size_t i = j; i < n; ++i) b[j] += std::fabs(c[i]) * static_cast<double>(i - j + 1);
  }
  double error = 0;
  for (std::size_t j = 0; j + 1 < n; ++j) {
    error += kUnit * (4 * b[j + 1] + b[j + 2] + 2 * b[j]) * static_cast<double>(j + 1);
  }
  return error;
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
  if (s.degree < 0) chop(k_series, truncation, peak * kUnit / 4);
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
  double rounding_k = 0, rounding_K = 0;
  for (std::size_t p = 0; p < pieces_.size(); ++p) {
    pieces_[p].k_first = coefficients_.size();
    for (const Dd c : k_series[p]) coefficients_.push_back((c / total).value());
    pieces_[p].K_first = coefficients_.size();
    for (const Dd c : K_series[p]) coefficients_.push_back((c / total).value());
  }
  for (const Piece& p : pieces_) {
    const std::span<const double> c(coefficients_.data() + p.k_first, terms);
    const std::span<const double> big(coefficients_.data() + p.K_first, terms + 1);
    double slope = 0;  // |T_j'| <= j^2
    for (std::size_t j = 0; j < terms; ++j) slope += std::fabs(c[j]) * static_cast<double>(j * j) / p.half;
    k_max_ = std::max(k_max_, absolute_sum(c, 1));
    K_max_ = std::max(K_max_, absolute_sum(big, 1));
    slope_max_ = std::max(slope_max_, slope);
    // t = (x - mid) * inverse_half has four roundings of relative size u, and that of mid itself.
    const double shift = kUnit * (4 * p.half + std::fabs(p.mid));
    rounding_k = std::max(rounding_k, clenshaw_error(c) + shift * slope);
    rounding_K = std::max(rounding_K, clenshaw_error(big) + shift * absolute_sum(c, 1));
  }
  const double fit = truncation.error / std::fabs(integral_);
  // The integral errs by at most support * truncation: dividing by it changes k and K by that share of themselves.
  const double support = 2 * radius();
  const double normalised = support * fit;
  k_error_ = fit + k_max_ * normalised + kUnit * k_max_ + rounding_k;
  K_error_ = support * fit + K_max_ * normalised + kUnit * K_max_ + rounding_K;
  for (int p = 0; p <= pieces(); ++p) {
    const double knot = knots_[static_cast<std::size_t>(p)];
    const double left = p > 0 ? k_piece(p - 1, knot) : 0, right = p < pieces() ? k_piece(p, knot) : 0;
    jump_max_ = std::max(jump_max_, std::fabs(left - right));
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

int Kernel::piece_of(double x) const noexcept {
  return static_cast<int>(std::upper_bound(knots_.begin(), knots_.end(), x) - knots_.begin()) - 1;
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

// Blocks of eight, so that the compiler makes vectors of the inner loops; every lane does what evaluate() does.
void Kernel::weights(std::span<const double> x, std::span<double> out) const noexcept {
  constexpr std::size_t kLanes = 8;
  for (std::size_t first = 0; first < x.size(); first += kLanes) {
    const std::size_t n = std::min(kLanes, x.size() - first);
    double at[kLanes], value[kLanes] = {};
    double low = HUGE_VAL, high = -HUGE_VAL;
    for (std::size_t i = 0; i < kLanes; ++i) {
      at[i] = x[first + std::min(i, n - 1)];
      low = std::min(low, at[i]);
      high = std::max(high, at[i]);
    }
    const int last = std::min(piece_of(high), pieces() - 1);
    for (int p = std::max(piece_of(low), 0); p <= last; ++p) {
      const Piece& piece = pieces_[static_cast<std::size_t>(p)];
      const double left = knots_[static_cast<std::size_t>(p)], right = knots_[static_cast<std::size_t>(p) + 1];
      const double* c = coefficients_.data() + piece.k_first;
      double t[kLanes], b1[kLanes] = {}, b2[kLanes] = {};
      for (std::size_t i = 0; i < kLanes; ++i) t[i] = (at[i] - piece.mid) * piece.inverse_half;
      for (int j = degree_; j >= 1; --j) {
        for (std::size_t i = 0; i < kLanes; ++i) {
          const double b = c[j] + ((t[i] + t[i]) * b1[i] - b2[i]);
          b2[i] = b1[i];
          b1[i] = b;
        }
      }
      for (std::size_t i = 0; i < kLanes; ++i) {
        const double k = c[0] + (t[i] * b1[i] - b2[i]);
        value[i] = at[i] >= left && at[i] < right ? k : value[i];
      }
    }
    std::copy(value, value + n, out.begin() + static_cast<std::ptrdiff_t>(first));
  }
}

}  // namespace moire
