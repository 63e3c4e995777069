// A kernel's shape as a plug-in gives it, and the fit of Chebyshev series to its pieces, with a proven bound.
#pragma once

#include <functional>
#include <vector>

#include "core/double_double.h"

namespace moire {

// What a plug-in gives: see FilterType in filter.h. Neighbouring knots are at least 2^-30 of the radius apart, far more
// than the rounding of a position.
struct KernelShape {
  std::vector<double> knots;
  int degree = -1;
  std::function<Dd(int piece, Dd x)> shape;
  std::function<double(int piece, double rho)> ellipse_bound;
};

// One series a piece, in t = (x - middle) / half_length, all of the same degree.
struct ShapeFit {
  std::vector<Dd> middle, half_length;
  std::vector<std::vector<Dd>> series;
  int degree = 0;
  double error = 0;  // bound on |series - shape|, in the shape's scale
};
ShapeFit fit_shape(const KernelShape& shape);

}  // namespace moire
