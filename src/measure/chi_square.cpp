// Quantiles of the chi-square distribution: E. B. Wilson and M. M. Hilferty's cube root ("The distribution of
// chi-square", PNAS 17, 1931), then Newton's steps on the incomplete gamma function.
#include "measure/chi_square.h"

#include <cmath>

namespace moire {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kNormal975 = 1.959963984540054;  // the normal deviate of 97.5%
// From here on the cube root alone is good to 1e-10 (its error falls as degrees^-3/2: 4e-9 at 10^5), and the series
// below, with some 10 sqrt(a) terms, grow long.
constexpr double kLarge = 2e6;

// x^a e^-x / Gamma(a + 1). For large a by Stirling's series (Abramowitz, Stegun, 1964, 6.1.41) in a form without large
// powers: the exponent a (m - log(1 + m)), m = (x - a) / a, is of order 1 where it matters.
double gamma_term(double a, double x) {
  constexpr double kStirling = 12;  // first omitted term of the series here: 1 / (1188 a^9) < 2e-13
  if (a < kStirling) return std::pow(x, a) * std::exp(-x) / std::tgamma(a + 1);
  const double m = (x - a) / a, i = 1 / a, i2 = i * i;
  const double series = i * (1.0 / 12 - i2 * (1.0 / 360 - i2 * (1.0 / 1260 - i2 / 1680)));
  return std::exp(-a * (m - std::log1p(m)) - series) / std::sqrt(2 * kPi * a);
}

// P(a, x), the regularised incomplete gamma function: its power series below a + 1 (same book, 6.5.29), 1 minus the
// continued fraction of Q above (6.5.31, evaluated by W. J. Lentz's method, Applied Optics 15(3), 1976).
double gamma_p(double a, double x) {
  constexpr double kEnd = 1e-17;
  const double scale = gamma_term(a, x);
  if (x < a + 1) {
    double sum = 1, term = 1;
    for (double n = 1; term > kEnd * sum; ++n) {
      term *= x / (a + n);
      sum += term;
    }
    return scale * sum;
  }
  // Q = x^a e^-x / Gamma(a) / (x + 1 - a - 1 (1 - a) / (x + 3 - a - 2 (2 - a) / (x + 5 - a - ...))).
  double b = x + 1 - a, c = 1e300, d = 1 / b, fraction = d;
  for (double n = 1, change = 2; std::fabs(change - 1) > 1e-16; ++n) {
    const double numerator = -n * (n - a);
    b += 2;
    d = 1 / (numerator * d + b);
    c = b + numerator / c;
    change = c * d;
    fraction *= change;
  }
  return 1 - scale * a * fraction;
}

double quantile(double probability, double deviate, double degrees) {
  const double spread = 2 / (9 * degrees);
  const double root = 1 - spread + deviate * std::sqrt(spread);
  const double a = degrees / 2;
  // Where the cube root is too small to start from (few degrees, low end) the leading term of P, x^a / Gamma(a + 1),
  // is nearly all of it.
  double x = degrees < 4 && deviate < 0 ? std::pow(probability * std::tgamma(a + 1), 1 / a) : a * root * root * root;
  if (degrees > kLarge) return 2 * x;
  for (int step = 0; step < 40; ++step) {
    const double change = (gamma_p(a, x) - probability) * x / (a * gamma_term(a, x));
    x = change < x ? x - change : x / 2;  // x stays positive
    if (std::fabs(change) <= 1e-13 * x) break;
  }
  return 2 * x;
}

}  // namespace

Interval chi_square95(double degrees) {
  return {quantile(0.025, -kNormal975, degrees), quantile(0.975, kNormal975, degrees)};
}

Interval power_interval(double mean, double degrees) {
  const Interval chi = chi_square95(degrees);
  return {mean * (degrees / chi.hi), mean * (degrees / chi.lo)};
}

}  // namespace moire
