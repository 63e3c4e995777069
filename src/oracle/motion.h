// Values of edges and disks that move while the shutter is open: the mean over time of still values.
#pragma once

#include "oracle/kernel.h"
#include "oracle/scene.h"

namespace moire::oracle {

// Mean over t in [0, 1] of the scene moved by t motion, under k; for kernels of few pieces, polynomials between their
// knots. Time is cut where the boundary passes a corner of knot lines: between those the still value of an edge is a
// polynomial in t.
Value moving(const Kernel& k, const Edge& edge, Vec2 motion, Pixel pixel);
// The same of a disk under the box of that width. Time is cut where the circle touches a side or passes a corner, and
// counted so that the roots there are none.
Value moving(const Disk& disk, Vec2 motion, Pixel pixel, double width);

}  // namespace moire::oracle
