// The F distribution, by the incomplete beta function's continued fraction: F. W. J. Olver et al. (eds.), "NIST
// Handbook of Mathematical Functions", 2010, section 8.17.
#include "measure/f_distribution.h"

#include <cmath>
#include <numbers>

namespace moire {
namespace {

// log Gamma(x), x > 0, less its leading part (x - 1/2) log x - x + log(2 pi) / 2: a small number for large x, by
// Stirling's series (5.11.1), whose first omitted term is below 1e-17 from 15 on; smaller x climb there.
// std::lgamma is not used: it writes a global.
double stirling_rest(double x) {
  double shift = 0;
  // rest(x) = rest(x + 1) + (x + 1/2) log(1 + 1/x) - 1.
  for (; x < 15; ++x) shift += (x + 0.5) * std::log1p(1 / x) - 1;
  const double i = 1 / x, i2 = i * i;
  return shift + i * (1.0 / 12 - i2 * (1.0 / 360 - i2 * (1.0 / 1260 - i2 * (1.0 / 1680 - i2 * (1.0 / 1188)))));
}

// log(p / q) for p and q that may be close.
double log_ratio(double p, double q) { return std::fabs(p - q) < 0.5 * q ? std::log1p((p - q) / q) : std::log(p / q); }

// x^a (1-x)^b / B(a, b), y = 1 - x. The powers are taken of x and y over their values at the peak, a / (a + b) and
// b / (a + b), so that large exponents meet numbers near 1.
double front(double a, double b, double x, double y) {
  const double n = a + b;
  const double log_powers = a * log_ratio(x * n, a) + b * log_ratio(y * n, b);
  const double log_gammas = stirling_rest(n) - stirling_rest(a) - stirling_rest(b);
  return std::exp(log_powers + log_gammas) * std::sqrt(a * b / (n * 2 * std::numbers::pi));
}

// I_x(a, b) by 8.17.22, which is quick for x below the mean; y = 1 - x. W. J. Lentz's way of evaluation, 1976.
double lower_part(double a, double b, double x, double y) {
  double c = 1, d = 1 - (a + b) * x / (a + 1);
  if (d == 0) d = 1e-300;
  d = 1 / d;
  double fraction = d;
  for (double m = 1, change = 2; std::fabs(change - 1) > 1e-16 && m < 1e6; ++m) {
    const auto step = [&](double numerator) {
      d = 1 / (1 + numerator * d);
      c = 1 + numerator / c;
      change = c * d;
      fraction *= change;
    };
    step(m * (b - m) * x / ((a + 2 * m - 1) * (a + 2 * m)));
    step(-(a + m) * (a + b + m) * x / ((a + 2 * m) * (a + 2 * m + 1)));
  }
  return front(a, b, x, y) / a * fraction;
}

double beta(double a, double b, double x, double y) {
  if (x <= 0) return 0;
  if (y <= 0) return 1;
  return x < (a + 1) / (a + b + 2) ? lower_part(a, b, x, y) : 1 - lower_part(b, a, y, x);
}

}  // namespace

double incomplete_beta(double a, double b, double x) { return beta(a, b, x, 1 - x); }

double f_survival(double x, double upper, double lower) {
  if (std::isinf(x)) return 0;
  // P(F >= x) = I(lower / (lower + upper x); lower / 2, upper / 2).
  const double sum = lower + upper * x;
  return beta(lower / 2, upper / 2, lower / sum, upper * x / sum);
}

Interval f95(double upper, double lower) {
  const auto quantile = [&](double survival) {
    // Of the logarithm, by halving: after 64 steps the range is 1e-17.
    double lo = -100, hi = 100;
    for (int i = 0; i < 64; ++i) {
      const double middle = (lo + hi) / 2;
      (f_survival(std::exp(middle), upper, lower) > survival ? lo : hi) = middle;
    }
    return std::exp((lo + hi) / 2);
  };
  return {quantile(0.975), quantile(0.025)};
}

}  // namespace moire
