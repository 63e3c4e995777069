// Boards without end in one-point perspective, to their horizon: values by sums over periods.
#pragma once

#include "oracle/kernel.h"
#include "oracle/scene.h"

namespace moire::oracle {

// Integral of the board times k(x) k(y) around the pixel's centre, for kernels that are polynomials of degree 3 at most
// between their knots, and boards whose V and W do not depend on x: rows (a b c), (0 e d), (0 w z), a > 0 and w > 0.
//
// s = +-1 is the square wave, the board (1 + s(u) s(v)) / 2. With t = 1/W a row of the window has v = alpha + beta t,
// and at the knots u = alpha' + beta' t. By parts its integral of k(x) s(u) is a sum over the knots of jumps of k and
// its derivatives times F_j(u) / (a t)^j, where F_1' = s, F_2' = F_1 ... of period 2 and mean 0, and it ends with the
// polynomial's degree; k(y) dy is a polynomial in 1/t times dt / (w t^2). Where all the beta are integers, everything
// but the powers of 1/t has the period 2, and these add up to Hurwitz's zeta functions, by Euler and Maclaurin's
// formula (NIST Digital Library of Mathematical Functions, 2.10.1 and 25.11). No square is clipped, and no term is
// dropped on the way to the horizon.
//
// Throws std::invalid_argument for other boards and kernels, and for betas that are no integers. Best near the horizon:
// rounding, which the error states, grows like (distance in kernel widths)^3.
Value one_point(const Kernel& k, const Board& board, Pixel pixel);

}  // namespace moire::oracle
