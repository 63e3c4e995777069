// The area of an endless checkerboard's even squares inside a polygon, from the polygon's sides alone: the way to
// pixels that hold thousands of squares, or the horizon and no end of them.
//
// The idea is repeated integration by parts, which turns the square wave into Euler polynomials (Digital Library of
// Mathematical Functions, 24.2 and 24.17) and an integral over an area into one over its sides.
//
// Notation. Rows U, V, W of the homography as functions of the image point p, u = U/W, v = V/W, det its determinant,
// s(u) = (-1)^floor(u). The density of even squares is (1 + s(u) s(v)) / 2, so that the area is (|P| + J) / 2 with J
// the integral of s(u) s(v) over the polygon P. Along u at constant v, dW/du = -e W^2 with a constant e, and dx dy =
// W^3 / |det| du dv. With E_0 = s, E_(j+1)' = E_j, all antiperiodic (E_j is the Euler polynomial of degree j over j! on
// [0, 1)), m integrations by parts in u give
//
//   J = 1/det sum over sides of C integral_0^1 s(v) sum_(j<m) c_j e^j W^(j+1) E_(j+1)(u) dtau + R,
//   |R| <= sup|E_m| c_m |P| max over P of |e W|^m,   c_j = (j + 2)! / 2,
//
// where a side is p(tau), 0 <= tau <= 1, in the polygon's order, and C = V'W - VW' is constant on it (' = d/dtau).
// Where no line u or v = integer is crossed, W^(j+1) E_(j+1)(u) is a polynomial of degree j + 1 in tau, and
// Gauss-Legendre quadrature is exact. The same holds with u and v exchanged. The work grows with the lines that cross
// the polygon's sides, not with its squares. In one-point perspective e = 0, and one term is everything.
//
// On the horizon, W = 0, infinitely many lines cross the sides that meet it. The polygon's side on the horizon itself
// contributes nothing; of the others the stretch with W < delta is left out, which is at most
// |C / det| sup|E_1| integral of W over it. Nothing is assumed of cancellation in there: where both families of lines
// cross a side in step there is none.
#pragma once

#include "curve/polygon.h"
#include "testimages/homography.h"
#include "testimages/testimage.h"

namespace moire {

// Pieces of a side between lines of the board; a window of one pixel on the horizon has two sides with so many, of two
// or three nodes each.
inline constexpr double kMaxPieces = 40000;

// Sides are cut into at most `max_pieces` pieces each; what is left towards the horizon is in the bound, which falls
// with the square of that number.
//
// `polygon` is convex, in order (closed integral of x dy positive), relative to the pixel's centre like `local`, and
// lies where W >= 0, up to rounding. The bound holds for the polygon as it stands: remainder, rounding and the horizon.
// Never more than half the polygon's area, which is known beforehand.
BoxIntegral board_series(const LocalHomography& local, const Polygon& polygon, double max_pieces = kMaxPieces);

}  // namespace moire
