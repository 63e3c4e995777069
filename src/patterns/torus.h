// Moving points on the unit torus, [0, 1) with its ends joined.
#pragma once

#include <span>

namespace moire {

// x + shift for x and shift in [0, 1); a sum that rounds to 1 becomes 0. Loops over it vectorise only if the
// subtraction, which is exact where it counts, does not wait for the comparison.
inline double wrapped(double x, double shift) noexcept {
  const double sum = x + shift, less = sum - 1.0;
  return less >= 0.0 ? less : sum;
}

// Writes the shifted numbers to `to`, which must not overlap `from`.
inline void shift_into(std::span<const double> from, double shift, double* __restrict to) noexcept {
  for (std::size_t i = 0; i < from.size(); ++i) to[i] = wrapped(from[i], shift);
}

}  // namespace moire
