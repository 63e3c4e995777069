// A checkerboard's homography as repeated integration by parts sees it (checker_series.h): along lines of constant v
// the image point p moves with u by dp/du = W (G - e p), and dW/du = -e W^2.
#pragma once

#include "core/geometry.h"
#include "testimages/board_side.h"
#include "testimages/homography.h"

namespace moire {

struct BoardFrame {
  // The family that integration by parts makes smooth, the one that jumps, and W.
  LocalHomography::Row smooth, jump, w;
  Bounded det;  // of the three rows in this order
  Bounded e;    // third entry of the first column of the inverse

  BoardFrame(const LocalHomography::Row& smooth, const LocalHomography::Row& jump, const LocalHomography::Row& w);
  // Whether the determinant is known well enough to divide by.
  bool valid() const;
  // Times a factor.
  Bounded e_times(double factor) const;
  // G - e p at a point, times a factor; (G is that at the origin).
  struct Drift {
    Bounded x, y;
  };
  Drift drift(Vec2 p, double factor) const;
};

}  // namespace moire
