// Endless alternating sums of Euler polynomials at equal steps with weights that fall like a power: what jumps at a
// checkerboard's lines leave when one integrates by parts towards the horizon (square_wave_tail.h).
#pragma once

#include <span>

#include "core/double_double.h"
#include "testimages/square_wave_tail.h"

namespace moire {

// The sum over k >= 0 of (-1)^k sum over i of weight[i] E_(order + i)(phase + k step) x_k^(-p - i), x_k = x + k
// spacing.
struct JumpSum {
  int order;  // 2 <= order, order + weight.size() - 1 <= kMaxTerms
  int p;      // >= 2
  Dd phase, step;
  double phase_error, step_error;
  double x, spacing;  // x >= 1, spacing > 0; right to 4u
  // weight[0] = 1; the others at most x times the one before, and 100 / kDense times that where the sum is dense.
  std::span<const double> weight;
};

// The sum with a bound, which it tries to bring below `goal`: whichever of at most kMaxDirect terms and kMaxHarmonics
// harmonics of the rest gets there in the least time.
inline constexpr double kMaxDirect = 200000;
inline constexpr double kMaxHarmonics = 40000;
Tail jump_sum(const JumpSum& sum, double goal);

}  // namespace moire
