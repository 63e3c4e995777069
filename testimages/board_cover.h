// Whether a rectangle lies in one square of a checkerboard, in plain doubles: the common case of Checkerboard::cover().
#pragma once

#include <optional>

#include "core/geometry.h"
#include "testimages/board_lines.h"
#include "testimages/homography.h"
#include "testimages/testimage.h"

namespace moire {

// The closed rectangle `r`, relative to the upper left corner of pixel `origin`; `h` as Checkerboard keeps it, entries
// up to 1. No answer where a sign that matters is in doubt: near the horizon, next to a line, far from the origin.
std::optional<Cover> quick_cover(const Matrix3& h, const Extent& extent, Pixel origin, Rect r) noexcept;

}  // namespace moire
