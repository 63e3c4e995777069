// Elementary functions with about 100 bits, for tables made once: Chebyshev points, kernel shapes, directions in
// degrees.
#pragma once

#include "core/double_double.h"

namespace moire {

inline constexpr Dd kPi{0x1.921fb54442d18p+1, 0x1.1a62633145c07p-53};
inline constexpr Dd kLn2{0x1.62e42fefa39efp-1, 0x1.abc9e3b39803fp-56};

struct CosSin {
  Dd cos, sin;
};

// |angle| <= 0.8 radians (an octant and a little). Taylor series; the first dropped term is below 0.8^27 / 27! <
// 2^-100.
inline CosSin dd_cos_sin(Dd angle) {
  const Dd square = angle * angle;
  CosSin r{1.0, angle};
  Dd cosine_term = 1.0, sine_term = angle;
  for (int k = 1; k <= 13; ++k) {
    cosine_term = cosine_term * square / Dd(-(2.0 * k - 1) * (2.0 * k));
    sine_term = sine_term * square / Dd(-(2.0 * k) * (2.0 * k + 1));
    r.cos = r.cos + cosine_term;
    r.sin = r.sin + sine_term;
  }
  return r;
}

// cos(pi p / q) for 0 <= p <= q, reduced to an octant in integers.
inline Dd dd_cos_pi(int p, int q) {
  if (2 * p > q) return -dd_cos_pi(q - p, q);
  const Dd unit = kPi / Dd(q);
  if (4 * p <= q) return dd_cos_sin(unit * Dd(p)).cos;
  return dd_cos_sin(unit * Dd(0.5 * (q - 2 * p))).sin;
}

// cos(pi x) and sin(pi x) for |x| < 2^50, absolute error below 2^-98: x less its nearest multiple of 1/2 is exact.
inline CosSin dd_cos_sin_pi(Dd x) {
  const double halves = std::nearbyint(2 * x.hi);
  CosSin r = dd_cos_sin(kPi * (x - Dd(0.5 * halves)));
  for (double turns = std::fmod(halves, 4.0); turns != 0; turns -= std::copysign(1.0, turns)) {
    r = turns > 0 ? CosSin{-r.sin, r.cos} : CosSin{r.sin, -r.cos};
  }
  return r;
}
inline Dd dd_cos_pi(Dd x) { return dd_cos_sin_pi(x).cos; }

// sin(pi x) / (pi x), 1 at 0.
inline Dd dd_sinc(Dd x) {
  if (x.hi == 0) return 1.0;
  return dd_cos_sin_pi(x).sin / (kPi * x);
}

// exp(x), relative error below 2^-94 (2^-101 per unit of |x|, plus the series); 0 below -745.
inline Dd dd_exp(Dd x) {
  if (x.hi < -745) return 0.0;
  const double k = std::nearbyint(x.hi / kLn2.hi);
  const Dd r = x - kLn2 * Dd(k);  // |r| < 0.35; the first dropped term is below 0.35^26 / 26! < 2^-120
  Dd sum = 1.0, term = 1.0;
  for (int i = 1; i <= 25; ++i) {
    term = term * r / Dd(i);
    sum = sum + term;
  }
  return {std::ldexp(sum.hi, static_cast<int>(k)), std::ldexp(sum.lo, static_cast<int>(k))};
}

// I0(sqrt(s)), the modified Bessel function of order 0, for 0 <= s <= 2^12 or so close below 0 that s is rounding: the
// sum of (s / 4)^k / (k!)^2. Its terms are positive, and those that count come before k = 100 at most: relative error
// below 100 * 17 * 2^-106 < 2^-95.
inline Dd dd_bessel_i0_of_root(Dd s) {
  const Dd quarter = s * Dd(0.25);
  Dd sum = 1.0, term = 1.0;
  for (int k = 1; std::fabs(term.hi) > 0x1p-110 * sum.hi; ++k) {
    term = term * quarter / Dd(static_cast<double>(k) * k);
    sum = sum + term;
  }
  return sum;
}

inline Dd dd_abs(Dd x) { return x.hi < 0 ? -x : x; }

}  // namespace moire
