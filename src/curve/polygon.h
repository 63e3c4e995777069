// Convex polygons cut by half-planes: Sutherland and Hodgman, "Reentrant polygon clipping", CACM 17(1), 1974.
#pragma once

#include <vector>

#include "core/geometry.h"

namespace moire {

// The half-plane a x + b y + c >= 0.
struct HalfPlane {
  double a = 0, b = 0, c = 0;
  double at(Vec2 p) const { return a * p.x + b * p.y + c; }
};

// Vertices in order; empty: nothing.
using Polygon = std::vector<Vec2>;

// The square [-h, h]^2, oriented so that the closed integral of x dy is positive.
Polygon square(double half_width);

// The part of `polygon` inside `half_plane`, in `out` (which must be another polygon); orientation is kept. A new
// vertex on a side of constant x or y has exactly that x or y. Every vertex of `out` lies within 4 2^-53
// max|coordinate| of the side that it was cut from, and within that plus twice the rounding error of half_plane.at() of
// the cutting line.
void clip(const Polygon& polygon, const HalfPlane& half_plane, Polygon& out);

// Sum of the sides' lengths.
double perimeter(const Polygon& polygon);

}  // namespace moire
