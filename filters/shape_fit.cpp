// Fitting Chebyshev series to a kernel's pieces. All of it in double-double until the coefficients are rounded, so that
// the errors of the fitted k are just two:
//  - truncation: interpolation in n + 1 Chebyshev points misses a function bounded by M on the ellipse rho by at most
//    4 M rho^-n / (rho - 1) (Trefethen, "Approximation Theory and Approximation Practice", 2013, thm 8.2); zero for
//    polynomials of degree n;
//  - rounding of the coefficients to double: u = 2^-53 times their absolute sum.
#include "filters/shape_fit.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/dd_math.h"
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

}  // namespace

ShapeFit fit_shape(const KernelShape& s) {
  const int pieces = static_cast<int>(s.knots.size()) - 1;
  double peak = 0;
  for (int p = 0; p < pieces; ++p) {
    const auto i = static_cast<std::size_t>(p);
    for (int j = 0; j <= 8; ++j) {
      peak = std::max(peak, std::fabs(s.shape(p, s.knots[i] + (s.knots[i + 1] - s.knots[i]) * j / 8).hi));
    }
  }
  Truncation truncation = s.degree < 0 ? choose_degree(s, peak * 0x1p-60) : Truncation{s.degree, 0};
  ShapeFit fit;
  for (int p = 0; p < pieces; ++p) {
    const Dd left = s.knots[static_cast<std::size_t>(p)], right = s.knots[static_cast<std::size_t>(p) + 1];
    fit.middle.push_back(Dd(0.5) * (left + right));
    fit.half_length.push_back(Dd(0.5) * (right - left));
    fit.series.push_back(interpolate([&](Dd t) { return s.shape(p, fit.middle.back() + fit.half_length.back() * t); },
                                     truncation.degree));
  }
  if (s.degree < 0) chop(fit.series, truncation, peak * kUnit / 16);
  fit.degree = truncation.degree;
  // Shapes are right to 2^-80 of their peak (filter.h), which interpolation in at most 41 points enlarges by less than
  // 3.4, its Lebesgue constant; with room for a peak between the points looked at.
  fit.error = truncation.error + 0x1p-77 * peak;
  return fit;
}

}  // namespace moire
