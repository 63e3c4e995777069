// The area of a checkerboard's even squares inside one pixel's window, in plain doubles: quick where few lines of the
// board cross the window.
//
// The board is cut along its lines, and the area is a sum of trapezoids (Green: area = closed integral of x dy) over
// the pieces of the window's outline and of the lines. Ends and crossings of lines are computed once and shared by the
// squares around them, so that the pieces always close: an end may slide along its line without harm, and only its
// distance from the line counts.
#pragma once

#include <optional>

#include "testimages/board_lines.h"
#include "testimages/homography.h"
#include "testimages/testimage.h"

namespace moire {

// The window of that half width around the centre of pixel `origin`; `h` as Checkerboard keeps it, entries up to 1.
// No answer where the window comes near the horizon, where more than kMostLines lines of a family cross it, or where
// the bound would not be below kPlainBound of the window's area.
std::optional<BoxIntegral> board_box(const Matrix3& h, const Extent& extent, Pixel origin, double half_width);

inline constexpr int kMostLines = 16;
inline constexpr double kPlainBound = 2e-14;

}  // namespace moire
