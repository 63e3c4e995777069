#include "filters/chebyshev_series.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/rounding.h"

namespace moire {

void chebyshev_sums(const double* c, int degree, std::span<const double> t, double* out) noexcept {
  constexpr std::size_t kLanes = 4;
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
  for (; i < t.size(); ++i) out[i] = chebyshev_sum(c, degree, t[i]);
}

double absolute_sum(std::span<const double> c, double rho) noexcept {
  double sum = 0;
  for (std::size_t j = c.size(); j-- > 0;) sum = sum * rho + std::fabs(c[j]);
  return sum;
}

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

std::vector<double> derivative(std::span<const double> c) {
  std::vector<double> d(c.size() + 1, 0.0);
  for (std::size_t j = c.size(); j-- > 1;) d[j - 1] = d[j + 1] + 2 * static_cast<double>(j) * c[j];
  d[0] *= 0.5;
  d.resize(std::max<std::size_t>(c.size() - 1, 1));
  return d;
}

std::vector<Dd> antiderivative(std::span<const Dd> c, Dd half, Dd& value) {
  const std::size_t terms = c.size();
  std::vector<Dd> big(terms + 1);
  const auto at = [&](std::size_t j) { return j < terms ? c[j] : Dd(0.0); };
  big[1] = half * (at(0) - at(2) * Dd(0.5));
  for (std::size_t j = 2; j <= terms; ++j) big[j] = half * (at(j - 1) - at(j + 1)) / Dd(2.0 * static_cast<double>(j));
  Dd at_left = 0.0, at_right = 0.0;  // T_j(-1) = (-1)^j, T_j(1) = 1
  for (std::size_t j = 1; j <= terms; ++j) {
    at_left = at_left + (j % 2 == 0 ? big[j] : -big[j]);
    at_right = at_right + big[j];
  }
  big[0] = value - at_left;
  value = big[0] + at_right;
  return big;
}

// t T_0 = T_1, t T_j = (T_{j-1} + T_{j+1}) / 2.
std::vector<Dd> times_linear(std::span<const Dd> c, Dd a, Dd b) {
  std::vector<Dd> product(c.size() + 1);
  for (std::size_t j = 0; j < c.size(); ++j) {
    product[j] = product[j] + a * c[j];
    if (j == 0) {
      product[1] = product[1] + b * c[0];
      continue;
    }
    const Dd half = Dd(0.5) * b * c[j];
    product[j - 1] = product[j - 1] + half;
    product[j + 1] = product[j + 1] + half;
  }
  return product;
}

double append_rounded(std::span<const Dd> series, Dd divisor, std::vector<double>& out) {
  double lost = 0;
  for (const Dd c : series) {
    const Dd share = c / divisor;
    out.push_back(share.value());
    lost += std::fabs((share - Dd(out.back())).hi) + 0x1p-90 * std::fabs(share.hi);
  }
  return lost;
}

}  // namespace moire
