// How much an endless checkerboard's squares may differ from half their area, seen through a weight: what may be said
// of the part of a window that is not resolved into squares.
//
// In the notation of checker_series.h, with the integral of g (density - 1/2) over a polygon P being J / 2, one and two
// integrations by parts along u (or v, exchanged) give J as the sum over sides of C / det times the integral of
//
//   s(v) (E_1(u) W g - E_2(u) W^2 g_1) dtau,   g_1 = Y g - 3 e g,   Y = (G - e p) . grad,
//
// (the second term with two integrations only), with G the first two entries of the first column of the inverse
// homography and e its third, and what is left is the integral over P of -E_1 s W g_1, or of E_2 s W^2 g_2, g_2 = Y g_1
// - 4 e g_1. All of that is bounded by absolute values, sup|E_1| = 1/2 and sup|E_2| = 1/8: no side and no line between
// squares is visited, and the horizon is nothing special, W being zero there. A curve in P across which g or its slope
// jumps counts as a side with the jump for g.
//
// A side along u = k + 1/2, where E_1 = 0, is of second order like the rest.
#pragma once

#include "curve/boundary.h"
#include "curve/sharp_polygon.h"
#include "testimages/homography.h"

namespace moire {

// The side of a polygon in the given slot runs along the line u = at or v = at through the middle of squares.
struct MiddleLine {
  int slot = -1;
  bool of_u = false;
  double at = 0;
};

// `part` in order (closed integral of x dy positive), relative to the pixel's centre like `local`, with its rounded
// vertices where W >= 0 but for rounding, inside the window whose sides have the slots below SharpClipper::kWindow.
Unresolved half_covered(const LocalHomography& local, const SharpPolygon& part, const MiddleLine& middle = {});

}  // namespace moire
