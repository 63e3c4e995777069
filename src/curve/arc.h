// Quarters of a circle, 45 degrees to either side of its four extreme points, as functions of the coordinate that runs
// along them: y on the right and left quarters, x on the upper and lower ones. There the slope is at most 1 and the
// circle is far from the square-root singularity at its ends.
//
// A piece of a quarter is seen from its middle, which comes from double-double; from there both coordinates have
// formulas free of cancellation, so that points are right to little more than the rounding of their coordinates,
// however large or far the circle.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "core/double_double.h"
#include "curve/boundary.h"

namespace moire {

// Coordinates in pixels from a pixel's centre. The parameter v is the running coordinate itself when the circle is
// large, and relative to the circle's centre when it is near: so it is as fine as the circle is small.
struct Arc {
  const Circle& circle;
  bool upright;  // y runs (right and left quarters)
  double side;   // +1: right or lower (towards +x, +y), -1: left or upper
  bool near;
  double c_run, c_other, rest_run, rest_other;
  // Where the quarter begins and ends, with the other coordinate there, shared with its neighbours bit for bit. The
  // true circle is within u |coordinate| (near: 1.07 u R) of there.
  double v0 = 0, v1 = 0, other0 = 0, other1 = 0;

  double run(double v) const { return near ? c_run + (v + rest_run) : v; }
  // v of a knot of the running coordinate.
  double v_of(double at) const { return near ? (at - c_run) - rest_run : at; }
  // Parameters where either coordinate is `at`, on this side of the circle; NaN for what is not. For a circle that
  // meets the window [-W, W]^2, near meaning R <= 4 W, and places in the window, the point is within 24 u W (and 2^-98
  // R) of both `at` and the circle:
  //  - near: coordinates are at most R + sqrt(2) W < 6 W, four roundings;
  //  - far: the other coordinate solves a^2 - 2 c a + q = 0 with q = v^2 - 2 c_v v - power. q errs by at most
  //    u (3 v^2 + 4 |c_v v| + 3 |power|), where |power| <= sqrt(2) W (2 R + sqrt(2) W) and |c_v| <= R + W: below
  //    u (13 W^2 + 12.5 R W) < 16 u R W. The denominator is at least sqrt(2) R - W > 1.1 R: below 16 u W, and 4 u W for
  //    the division and the square root.
  std::array<double, 3> passes(double at) const;
  // The other coordinate; bit for bit that of the neighbour at the quarter's ends.
  double other(double v) const;
};

// A piece of a quarter, from the point of parameter v.
struct ArcMiddle {
  double radius, side;
  Dd run, other;  // the point itself, from the pixel's centre
  // The point from the circle's centre.
  double relative, offset;

  ArcMiddle(const Arc& arc, double v);

  struct Point {
    double run, other;
    double relative, offset;  // from the circle's centre
  };
  // The point of parameter v + tau, on the same quarter. For tau exact, the point is off the circle by at most
  // u |coordinate| and 8 u |tau| in the other coordinate, u |coordinate| and u |tau| in the running one: with beta =
  // relative + tau, s = |offset| there and s_0 = |offset| here, other moves by -tau (relative + beta) / (s + s_0). Here
  // s and s_0 are right to 5 u and 2 u, and their sum to 4 u; relative + beta errs by 4 u R / sqrt(2), which over
  // s + s_0 >= sqrt(2) R is 2 u; product and quotient 2 u. Besides 2^-98 R of the double-double.
  Point at(double tau) const {
    const double beta = relative + tau;
    const double s = std::sqrt(std::max(0.0, (radius - beta) * (radius + beta)));
    const double move = -tau * (relative + beta) / (s + side * offset);
    return {run.hi + (run.lo + tau), other.hi + (other.lo + side * move), beta, side * s};
  }
};

// Which quarter: left, upper, right, lower.
enum class Quarter { left, upper, right, lower };

// `near`: v counts from the circle's centre.
Arc quarter(const Circle& circle, Quarter which, bool near);

// A rectangle that surely holds the quarter.
Rect around(const Circle& circle, Quarter which);

}  // namespace moire
