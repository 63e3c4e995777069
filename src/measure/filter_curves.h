// A filter drawn: its kernel, its frequency response, and an edge seen through it.
#pragma once

#include <vector>

#include "filters/filter.h"

namespace moire {

struct Curve {
  std::vector<double> x, y;
};

struct FilterCurves {
  // k(x) per pixel, of a radial filter k(|x|); x in pixels. Each piece between knots with both its ends, so that jumps
  // stand upright: the x of such a pair are equal. Straight pieces have no points between. A quarter pixel of 0 on
  // either side.
  Curve kernel;
  // The Fourier transform at f = 0, 1/64, ..., 3 cycles per pixel, 1 at 0, signed; of a kernel that is not even the
  // real part, its mean moved to 0; of a radial filter along any axis: its Hankel transform (R. Bracewell, "The Fourier
  // Transform and Its Applications", 1965).
  Curve response;
  // The value of a pixel whose centre is x pixels inside an upright edge, from half a pixel outside the support on.
  Curve edge;
};

// Errors below 1e-9, for drawing. Some milliseconds, of radial filters some tens; as the square of the radius.
FilterCurves filter_curves(const Filter& filter);

}  // namespace moire
