// The inverse distribution that importance estimators place samples by, at its hardest arguments, against kernels
// enclosed in ball arithmetic.
#pragma once

#include "filters/filter.h"
#include "stress/chance.h"
#include "stress/worst.h"

namespace moire::stress {

// Values are P(at(u)) - u A of engine/inverse_distribution.h, for u = 0, 2^-53, 1 - 2^-53, a few at random, and an ulp
// around those where the kernel changes its sign; bound by what that header claims. Severity is A: how much of |k|
// cancels. A fault where at() leaves the support, falls, or tells the wrong sign of a weight that is not about zero.
ManyValues inverse_case(Chance& chance, const Filter& filter);

}  // namespace moire::stress
