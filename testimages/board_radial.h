// The integral of a radial weight over an endless checkerboard's even squares in one pixel's window: square by square
// where that ends, by the series of radial_series.h where it does not.
#pragma once

#include "curve/boundary.h"
#include "testimages/board_lines.h"
#include "testimages/homography.h"
#include "testimages/radial_rings.h"
#include "testimages/testimage.h"

namespace moire {

// Around the window's centre; `local` relative to that, too. What is left to the squares and what is not resolved is
// appended to `rest`.
WeightIntegral board_radial(const LocalHomography& local, const Extent& extent, const RadialWeight& weight,
                            const WeightAim& aim, Boundary& rest);

}  // namespace moire
