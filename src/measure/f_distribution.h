// The F distribution, of the ratio of two mean powers.
#pragma once

#include "measure/statistics.h"

namespace moire {

// I_x(a, b), the regularised incomplete beta function, and 1 - I without cancellation: I(1 - x; b, a). a, b > 0,
// 0 <= x <= 1; relative error below 1e-10 for a, b to 1e6 where the result does not underflow.
double incomplete_beta(double a, double b, double x);

// P(F >= x) for `upper` and `lower` > 0 degrees of freedom, integer or not; small values keep their relative accuracy.
double f_survival(double x, double upper, double lower);

// The numbers that F stays below with probability 2.5% (lo) and 97.5% (hi).
Interval f95(double upper, double lower);

}  // namespace moire
