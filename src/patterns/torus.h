// Moving points on the unit torus, [0, 1) with its ends joined.
#pragma once

#include <span>

namespace moire {

// x + shift for x and shift in [0, 1); a sum that rounds to 1 becomes 0.
inline double wrapped(double x, double shift) noexcept {
  const double sum = x + shift;
  return sum - (sum >= 1.0 ? 1.0 : 0.0);  // in this form loops over it vectorise
}

// Writes the shifted numbers to `to`, which must not overlap `from`.
inline void shift_into(std::span<const double> from, double shift, double* __restrict to) noexcept {
  for (std::size_t i = 0; i < from.size(); ++i) to[i] = wrapped(from[i], shift);
}

}  // namespace moire
