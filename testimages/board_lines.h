// The lines of a checkerboard in perspective as lines of the image, relative to a pixel.
#pragma once

#include <cmath>

#include "core/rounding.h"
#include "curve/polygon.h"
#include "curve/sharp_polygon.h"
#include "testimages/homography.h"

namespace moire {

// u0 <= u <= u1, v0 <= v <= v1; infinite on all sides without an extent.
struct Extent {
  double u0 = -HUGE_VAL, u1 = HUGE_VAL, v0 = -HUGE_VAL, v1 = HUGE_VAL;
};

// Whether the square k <= u < k + 1, l <= v < l + 1 is inside; any integers as doubles.
inline bool even_square(double k, double l) {
  const double sum = k + l;
  return sum == 2 * std::floor(sum / 2);
}

// The line through the plane where row r equals k times row w, as sign * (r - k w) >= 0, with the rounding of its
// value.
struct BoardLine {
  HalfPlane plane;
  double constant_error;  // of c, from cancellation in double-double
  // Bound on the error of plane.at() at points up to (ax, ay) away.
  double doubt(double ax, double ay) const {
    return 6 * kUnit * (std::fabs(plane.a) * ax + std::fabs(plane.b) * ay + std::fabs(plane.c)) + constant_error;
  }
};

// The same line for cutting, in double-double.
inline SharpLine sharp_line(const LocalHomography::Row& r, const LocalHomography::Row& w, double k, double sign) {
  const auto oriented = [sign](Dd x) { return sign < 0 ? -x : x; };
  // A product and a sum in double-double, 2^-102 with room to spare.
  const double rounding = 0x1p-98 * (std::fabs(r.c.hi) + std::fabs(k * w.c.hi));
  return {oriented(Dd(r.a) - two_prod(k, w.a)), oriented(Dd(r.b) - two_prod(k, w.b)), oriented(r.c - Dd(k) * w.c),
          r.c_error + std::fabs(k) * w.c_error + rounding};
}

inline BoardLine board_line(const LocalHomography::Row& r, const LocalHomography::Row& w, double k, double sign) {
  const SharpLine l = sharp_line(r, w, k, sign);
  return {{l.a.value(), l.b.value(), l.c.value()}, l.error};
}

}  // namespace moire
