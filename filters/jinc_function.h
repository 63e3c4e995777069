// jinc(x) = 2 J1(pi x) / (pi x), jinc(0) = 1: the Fourier transform of a disk. J1 is the Bessel function of order 1.
#pragma once

#include <vector>

#include "core/double_double.h"
#include "filters/ellipse.h"

namespace moire {

inline constexpr int kJincZeros = 16;

// The zero of this number, from 1 to kJincZeros, to the nearest double.
double jinc_zero(int number);

// By the integral J1(y) = mean of sin(t) sin(y sin t) over a turn, taken as the mean over N equally spaced t: what that
// misses is J1 of higher orders, sums of J_{lN+-1}(y), l > 0 (the Fourier series of exp(i y sin t) has the coefficients
// J_m(y)), and |J_m(y)| <= (y / 2)^m / m! (Abramowitz and Stegun, "Handbook of Mathematical Functions", 1964, 9.1.62).
// N makes that less than 2^-100.
class JincFunction {
 public:
  // For 0 <= x <= `reach`.
  explicit JincFunction(double reach);

  // Absolute error below 2^-95.
  Dd operator()(Dd x) const;

 private:
  std::vector<Dd> sines_;  // of the t in the first quarter of the turn; the others repeat them
};

// Bound on |jinc(z)| for |Im z| <= height: it is a mean of sinc(z s), |s| <= 1, with positive weights.
inline double jinc_bound(double height) { return sinc_bound(height); }

}  // namespace moire
