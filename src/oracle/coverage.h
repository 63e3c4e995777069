// Box-filtered values by closed forms of areas: the first of the oracle's two unrelated methods.
#pragma once

#include "oracle/scene.h"

namespace moire::oracle {

// Area of the scene inside the square of that width (pixels) around the pixel's centre, over the square's area.
// Half-plane: the five cases of a corner cut off a square. Disk: between the heights where the circle meets the
// square's sides or turns, trapezoids and circular segments. Board: the shoelace formula over clipped squares. Where a
// board without end meets its horizon in the window, about `squares` of them are clipped; what lies beyond counts as
// half covered and half its area is in the error.
Value coverage(const Edge& edge, Pixel pixel, double width);
Value coverage(const Disk& disk, Pixel pixel, double width);
Value coverage(const Board& board, Pixel pixel, double width, double squares = 2000);
// The first two as they are around the pixel's centre.
Value coverage(const HalfPlane& half_plane, double width);
Value coverage(const Circle& circle, double width);

}  // namespace moire::oracle
