// Boards without end in one-point perspective under radial kernels, to their horizon: values by integrals along chords.
#pragma once

#include "oracle/chord_kernel.h"
#include "oracle/scene.h"

namespace moire::oracle {

// Integral of the board times k(r) around the pixel's centre, for boards of which one of V and U does not change along
// the horizon: a camera without yaw, or of 90 degrees, of any roll, or the mirror image of one.
//
// s = +-1 is the square wave, the board (1 + s(u) s(v)) / 2. With x along the horizon and depth d below it,
// u = a + b (x - c) / d and v = e + f / d. The integral over d of s(v) times a chord's integral (chord_kernel.h) goes
// by Gauss and Legendre between the lines of v, also cut where lines of u leave a circle on which k or a derivative
// jumps, where they touch it, and at the circles' own ends, whose square roots a substitution takes away.
//
// The horizon is reached by a limit: the integrand times a smooth step that is 0 at d <= D and 1 at d >= 2 D, for D
// halved again and again. What oscillates is gone faster than any power of D; what does not, where the slopes of u and
// v along a circle resonate, goes like D^2, D^3, ..., which Richardson's extrapolation takes away (Phil. Trans. R. Soc.
// London A 226, 1927). No square is clipped, no sum along the horizon is made.
//
// The error compares two resolutions, of which the value is the finer, and the finer one's last limits: an estimate,
// not a bound, of some 1e-12. Ten milliseconds to three seconds, like the focal length in pixels times the height in
// squares. Throws std::invalid_argument for other boards.
Value one_point(const ChordKernel& k, const Board& board, Pixel pixel);

}  // namespace moire::oracle
