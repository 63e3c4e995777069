// How many terms of a Chebyshev series a wave takes.
#pragma once

namespace moire {

// Terms of the Chebyshev series of exp(i c t), |t| <= 1, c >= 0, that rounding can see: the coefficient of T_j is
// 2 J_j(c), and |J_j(c)| <= (c/2)^j / j!.
inline int terms_of_wave(double c) {
  int j = 0;
  for (double term = 1; term > 1e-18 || j < c; ++j) term *= c / 2 / (j + 1);
  return j;
}

}  // namespace moire
