// What a kernel, as a weight over the plane, allows to say of parts of a window that are not resolved
// (curve/boundary.h).
#pragma once

#include "curve/boundary.h"
#include "filters/kernel.h"
#include "filters/radial_kernel.h"

namespace moire {

// k(x) k(y), over its whole support. Second derivatives are not bounded.
WeightBounds weight_bounds(const Kernel& kernel);

// k(r). It is zero where the sides of its window are.
WeightBounds weight_bounds(const RadialKernel& kernel);

// Bound on the integral's error from everything in `boundary` that is doubtful but its segments' ends. `k_error` bounds
// what the weight differs by from that of the bounds.
double doubt(const Boundary& boundary, const WeightBounds& weight, double k_error);

}  // namespace moire
