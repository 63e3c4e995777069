// The two-parameter family of piecewise cubics on [-2, 2], or stretched to [-radius, radius].
//
// Mitchell and Netravali, "Reconstruction filters in computer graphics", Computer Graphics 22(4), 1988. Outside one
// pixel the cubic is written in s = 2 - |x|. An exact 1/3 is understood for the double nearest to it.
#pragma once

#include <vector>

#include "core/dd_math.h"

namespace moire {

struct BcCubic {
  Dd b, c;
  double radius = 2;  // pixels

  // Parameters of a command line are doubles; the one nearest to 1/3 means 1/3.
  static Dd parameter(double x) { return x == 1.0 / 3 ? Dd(1) / Dd(3) : Dd(x); }

  std::vector<double> knots() const { return {-radius, -radius / 2, 0, radius / 2, radius}; }
  int degree() const { return 3; }
  Dd shape(int piece, Dd x) const {
    const Dd a = dd_abs(x) * (Dd(2) / Dd(radius));
    if (piece == 1 || piece == 2) {
      return ((Dd(2) - Dd(1.5) * b - c) * a + (Dd(-3) + Dd(2) * b + c)) * a * a + (Dd(1) - b / Dd(3));
    }
    const Dd s = Dd(2) - a;
    return ((b / Dd(6) + c) * s - c) * s * s;
  }
  double ellipse_bound(int, double) const { return 0; }  // a polynomial: never asked
};

}  // namespace moire
