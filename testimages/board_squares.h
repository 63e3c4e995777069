// A checkerboard in one pixel's window, clipped square by square.
#pragma once

#include "curve/boundary.h"
#include "curve/polygon.h"
#include "testimages/board_lines.h"

namespace moire {

// Beyond this many squares from the plane's origin floor() has no meaning in doubles.
inline constexpr double kMaxSquares = 0x1p50;
// The most squares of a window that are clipped one by one; where there are more, or no end of them, only so many are,
// nearest first.
inline constexpr int kMaxCells = 200000;
inline constexpr int kMaxCellsOfMore = 10000;

// Cuts polygons inside a window by lines of the board and keeps the error of what it cut.
class BoardCutter {
 public:
  explicit BoardCutter(double half_width) : half_width_(half_width) {}

  // Cuts `in` by sign (r - k w) >= 0 into `out`, which must be another polygon.
  void cut(const Polygon& in, const LocalHomography::Row& r, const LocalHomography::Row& w, double k, double sign,
           Polygon& out);
  // Largest distance of a vertex from the lines it should be on, so far, pixels.
  double distance() const { return distance_; }
  // Area, square pixels, that one cut across the window may have lost or gained.
  double slack() const { return 2 * distance_ * 2.83 * half_width_; }

 private:
  double half_width_, distance_ = 0;
};

// The window [-half_width, half_width]^2 around the pixel's centre, and the part of it where the board is: in front of
// the camera and within the extent.
struct BoardWindow {
  LocalHomography local;
  Extent extent;
  double half_width;
  BoardCutter cutter;
  Polygon board;

  BoardWindow(const LocalHomography& local, const Extent& extent, double half_width);
  // Bound on the area by which `board` differs from the true part.
  double board_error() const { return 5 * cutter.slack(); }
};

// About how many squares a polygon meets; infinite where it comes within rounding of the horizon.
double squares_met(const LocalHomography& local, const Polygon& polygon);

// Appends the boundary of the even squares inside the window. What lies beyond the squares that are clipped counts as
// half covered, with half its area in the area error.
void append_squares(BoardWindow& window, Boundary& out);

}  // namespace moire
