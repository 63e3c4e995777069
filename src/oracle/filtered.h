// Filtered values by iterated quadrature of the kernel itself: sections of the scene along rows, summed over rows.
#pragma once

#include "oracle/kernel.h"
#include "oracle/scene.h"

namespace moire::oracle {

// Integral of scene times k(x) k(y) around the pixel's centre. Rows are split wherever the section's ends pass a knot
// or change their curve, so that every integrand is analytic; two rules judge each other (quadrature.h).
// The disk is cut into its inscribed square and four caps, each seen from its flat side: no section has the square
// root's vertical tangent, and no part is subtracted from another.
Value filtered(const Kernel& k, const Edge& edge, Pixel pixel);
Value filtered(const Kernel& k, const Disk& disk, Pixel pixel);
Value filtered(const Kernel& k, const Board& board, Pixel pixel);
// The half-plane as it is around the pixel's centre.
Value filtered(const Kernel& k, const HalfPlane& half_plane);

}  // namespace moire::oracle
