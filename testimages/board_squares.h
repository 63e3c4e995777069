// A checkerboard in one pixel's window, clipped square by square.
#pragma once

#include "core/rounding.h"
#include "curve/boundary.h"
#include "curve/polygon.h"
#include "curve/sharp_polygon.h"
#include "testimages/board_lines.h"

namespace moire {

// Beyond this many squares from the plane's origin floor() has no meaning in doubles.
inline constexpr double kMaxSquares = 0x1p50;
// The most squares of a window that are clipped one by one; where there are more, or no end of them, only so many are,
// nearest first.
inline constexpr int kMaxCells = 200000;
inline constexpr int kMaxCellsOfMore = 10000;

// The window, a square [-half_width, half_width]^2 around the pixel's centre or a rectangle inside one, and the part of
// it where the board is: in front of the camera and within the extent.
struct BoardWindow {
  LocalHomography local;
  Extent extent;
  double half_width;
  SharpClipper clipper;
  SharpPolygon part;
  Polygon board;  // the same, vertices rounded

  // The clipper's slot for one cut of `part` more.
  static constexpr int kCut = SharpClipper::kWindow + 4;

  BoardWindow(const LocalHomography& local, const Extent& extent, double half_width);
  BoardWindow(const LocalHomography& local, const Extent& extent, const Rect& window);
  // Bound on the area by which `board` differs from the true part: the cuts, and the rounding of vertices by at most
  // 2^-53 half_width in x and in y, which moves sides no longer than the window's perimeter.
  double board_error() const { return clipper.area_error() + 12 * kUnit * half_width * half_width; }
};

// About how many squares a polygon meets; infinite where it comes within rounding of the horizon.
double squares_met(const LocalHomography& local, const Polygon& polygon);

// The same of the part of a polygon with W >= depth.
double squares_before(const LocalHomography& local, const Polygon& polygon, double depth);

// Largest W of a polygon, or 0.
double largest_w(const LocalHomography& local, const Polygon& polygon);

// The smallest W from `depth` to `deepest` with at most so many squares before it, to 2^-24 of the way.
double depth_with(const LocalHomography& local, const Polygon& polygon, double depth, double deepest, double squares);

// Its vertices.
Polygon rounded(const SharpPolygon& part);

// Appends the boundary of the even squares inside the window. What lies beyond the squares that are clipped counts as
// half covered and is unresolved.
void append_squares(BoardWindow& window, Boundary& out);

// How far a window of many squares is resolved under a weight of these bounds: until what is left comes to `goal` by
// them, with `least` squares or more (kMaxCellsOfMore and above: the usual number), or until there are `most`.
struct SquaresAim {
  WeightBounds weight;
  double goal, least, most;
};
void append_squares(BoardWindow& window, const SquaresAim& aim, Boundary& out);

}  // namespace moire
