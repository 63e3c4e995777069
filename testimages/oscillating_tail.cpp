// With the weight m(s) = s^(p-1) e^-s / (p-1)! the result is L = integral over s > 0 of m(s) / (s - i omega) ds, a
// Stieltjes function of z = -i omega: L = integral of m(s) / (s + z) ds.
#include "testimages/oscillating_tail.h"

#include <cmath>

#include "core/rounding.h"

namespace moire {
namespace {

struct Complex {
  double re, im;
};
Complex operator/(double a, Complex b) {
  const double n = b.re * b.re + b.im * b.im;
  return {a * b.re / n, -a * b.im / n};
}

// Below this the power series, which loses e^omega of its digits; above it the continued fraction, some 40 levels.
constexpr double kSmall = 4;

// DLMF 8.19.8: E_p(z) = (-z)^(p-1) / (p-1)! (psi(p) - ln z) - sum over m != p - 1 of (-z)^m / ((m - p + 1) m!).
OscillatingTail power_series(int p, double omega) {
  constexpr double kGamma = 0.57721566490153286061;
  double psi = -kGamma;
  for (int k = 1; k < p; ++k) psi += 1.0 / k;
  // The powers of -z = i omega over m!, of absolute value `size`, are in turn real and imaginary.
  double part[2] = {0, 0}, size = 1, sum = 0;
  const auto add = [&](int m, double factor) {
    part[m % 2] += (m & 2) == 0 ? factor * size : -factor * size;
    sum += std::fabs(factor) * size;
  };
  int m = 0;
  // From m = 2 omega + p on the terms halve, or better.
  for (; m < p || m < 2 * omega + p || size > 0x1p-60; ++m) {
    if (m != p - 1) {
      add(m, -1.0 / (m - p + 1));
    } else {
      const double log_z = std::log(omega), quarter = 1.5707963267948966;  // ln z = ln omega - i pi / 2
      add(m, psi - log_z);
      add(m + 1, quarter);  // i times what the power m is
    }
    size *= omega / (m + 1);
  }
  const double c = std::cos(omega), s = std::sin(omega);  // e^z = c - i s
  return {c * part[0] + s * part[1], c * part[1] - s * part[0], 2 * size + 32 * kUnit * (sum + 1)};
}

// i / omega times the sum over j of p (p+1) ... (p+j-1) (-i / omega)^j. Integration by parts leaves as remainder the
// next term times -i omega L of a larger p, and |omega L| <= 1: at most the first term left out.
OscillatingTail asymptotic_series(int p, double omega) {
  double part[2] = {0, 0}, size = 1 / omega;
  for (int j = 0; size > 0x1p-58 / omega && p + j < omega; ++j) {
    // i (-i)^j: i, 1, -i, -1.
    part[(j + 1) % 2] += (j & 2) == 0 ? size : -size;
    size *= (p + j) / omega;
  }
  return {part[0], part[1], size + 8 * kUnit / omega * (1 + 3 * p / omega)};
}

// DLMF 8.19.17: e^z E_p(z) = 1 / (z + p / (1 + 1 / (z + (p + 1) / (1 + 2 / (z + ...))))). Cut after n levels it is the
// Gauss quadrature of L with the weight m and n nodes, whose error is the integral of (P_n(s) / P_n(-z))^2 m(s) / (s +
// z) for P_n the monic generalised Laguerre polynomial (as for every Stieltjes function: Davis and Rabinowitz, "Methods
// of Numerical Integration", 1984, sec. 4.6): at most h_n / (omega |P_n(-z)|^2), h_n = n! (n + p - 1)! / (p - 1)! the
// integral of P_n^2 m.
//
// Evaluated from its end every z + ... adds numbers of one quadrant, and every 1 + ... a number with positive real
// part: relative errors do not grow, and a level adds 8u at most.
OscillatingTail continued_fraction(int p, double omega) {
  // ratio = P_(n+1) / P_n at i omega up to sign, by P_(n+1) = (s - 2n - p) P_n - n (n + p - 1) P_(n-1).
  Complex ratio{static_cast<double>(p), -omega};
  double bound = 1 / omega, reach = p / (ratio.re * ratio.re + omega * omega);
  int n = 1;
  for (bound *= reach; n < 200 && bound > 0x1p-54 / omega; ++n) {
    const double d = static_cast<double>(n) * (n + p - 1);
    const Complex back = d / ratio;
    ratio = {2 * n + p - back.re, -omega - back.im};
    reach = (n + 1.0) * (n + p) / (ratio.re * ratio.re + ratio.im * ratio.im);
    bound *= reach;
  }
  Complex v{0, -omega};
  v.re += p + n - 1;  // the last level, whose 1 + n / v is 1
  for (int k = n - 1; k >= 1; --k) {
    Complex w = k / v;
    w.re += 1;
    v = (p + k - 1) / w;
    v.im -= omega;
  }
  const Complex value = 1 / v;
  // Twice the bound for the rounding of the recurrence above, where real parts may cancel down to omega.
  return {value.re, value.im, 2 * bound + 8 * n * kUnit * (std::fabs(value.re) + std::fabs(value.im))};
}

}  // namespace

OscillatingTail oscillating_tail(int p, double omega) {
  const double w = std::fabs(omega);
  if (w == 0) return {1.0 / (p - 1), 0, kUnit};
  OscillatingTail out = w <= kSmall      ? power_series(p, w)
                        : w < 36 + 2 * p ? continued_fraction(p, w)
                                         : asymptotic_series(p, w);
  if (omega < 0) out.im = -out.im;
  return out;
}

}  // namespace moire
