// The closed boundary of a plane set as directed segments and whole circles, in pixels relative to a pixel's centre.
//
// Orientation: the closed integral of x dy over the boundary is the set's area, positive. (With y down and x to the
// right this walks from +x towards +y.)
#pragma once

#include <vector>

#include "core/geometry.h"

namespace moire {

// A directed straight piece. `weight` is 1 for the boundary of a set; a set of density w has weight w. `doubt`, pixels:
// each end may be off the true line by so much in either coordinate.
struct Segment {
  Vec2 a, b;
  double weight = 1;
  double doubt = 0;
};

// A whole circle, walked from +x towards +y. Its centre is center + center_rest, the second the rounding error of the
// first: a tiny circle's distance to a pixel's side needs both. Far from the origin the power of the origin,
// radius^2 - |centre|^2, cannot be had from the rounded centre; it is kept beside it, right up to 2^-53 relative plus
// 2^-98 radius^2.
struct Circle {
  Vec2 center, center_rest;
  double radius = 0;
  double power = 0;
};

struct Boundary {
  std::vector<Segment> segments;
  std::vector<Circle> circles;
  // Area (square pixels) inside the window where the described set may differ from the scene besides what the doubts of
  // segments allow: an upper bound on the symmetric difference, mostly from parts that were not resolved.
  double area_error = 0;

  void clear() {
    segments.clear();
    circles.clear();
    area_error = 0;
  }
};

}  // namespace moire
