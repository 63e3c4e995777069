// The closed boundary of a plane set as directed segments and whole circles, in pixels relative to a pixel's centre.
//
// Orientation: the closed integral of x dy over the boundary is the set's area, positive. (With y down and x to the
// right this walks from +x towards +y.)
#pragma once

#include <array>
#include <cmath>
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

// Bounds on a weight g: its largest value; that on the sides of the window; the sum of its jumps over all curves across
// which it jumps, each the boundary of a convex set; its slope, jumps of the slope (summed likewise) and second
// derivatives in any direction, a singular part of at most pole / distance to the window's centre apart. Infinite:
// unknown.
struct WeightBounds {
  double top = 0, rim = 0, jump = 0, slope = 0, kink = 0, curvature = 0, pole = 0;
};

// A part of the window that counts as half covered because what covers it is too fine to resolve. Under a weight g the
// integral over it errs by at most `area` (half of its area) times the largest |g|, and by at most any of the sums of
// products in `orders`, which are smaller where g is smooth.
struct Unresolved {
  double area = 0;  // square pixels
  std::array<WeightBounds, 4> orders;
  int known = 0;  // how many of the orders are

  double bound(const WeightBounds& g) const {
    const auto product = [](double x, double y) { return x == 0 ? 0 : x * y; };  // also where y is infinite
    double least = area * g.top;
    for (int i = 0; i < known; ++i) {
      const WeightBounds& o = orders[static_cast<std::size_t>(i)];
      least = std::fmin(least, product(o.top, g.top) + product(o.rim, g.rim) + product(o.jump, g.jump) +
                                   product(o.slope, g.slope) + product(o.kink, g.kink) +
                                   product(o.curvature, g.curvature) + product(o.pole, g.pole));
    }
    return least;
  }
};

struct Boundary {
  std::vector<Segment> segments;
  std::vector<Circle> circles;
  std::vector<Unresolved> unresolved;
  // Area (square pixels) inside the window where the described set may differ from the scene besides what the doubts of
  // segments allow and what is unresolved: an upper bound on the symmetric difference.
  double area_error = 0;

  // Of the area itself: that, and what is unresolved.
  double area_doubt() const {
    double sum = area_error;
    for (const Unresolved& u : unresolved) sum += u.area;
    return sum;
  }

  void clear() {
    segments.clear();
    circles.clear();
    unresolved.clear();
    area_error = 0;
  }
};

}  // namespace moire
