// One boundary integral for every separable filter: the integral of k(x) k(y) over a plane set equals the closed
// integral of K(x) k(y) dy over its boundary (Green), K the antiderivative of k from the left end of its support.
//
// The curves need no clipping: pieces left of the support contribute nothing (K = 0), pieces right of it their K(y)
// difference (K = 1), pieces above and below it nothing (k = 0). Inside, pieces are cut at the kernel's knots, where K
// and k change their formula, and integrated by Gauss-Legendre quadrature with a proven remainder.
#pragma once

#include <vector>

#include "core/sum.h"
#include "curve/arc.h"
#include "curve/boundary.h"
#include "engine/centred_integral.h"
#include "filters/kernel.h"

namespace moire {

class BoundaryIntegral {
 public:
  explicit BoundaryIntegral(const Kernel& kernel);

  // Sets the sum and its bound to zero.
  void reset();
  void add(const Segment& segment);
  void add(const Circle& circle);

  double value() const { return sum_.value(); }
  // Guaranteed bound on |value() - integral over the true curves|: rounding, quadrature, kernel fit and the doubts of
  // the segments.
  double bound() const;

 private:
  // The pieces of the kernel that x and y lie in, and bounds there.
  struct Cell {
    int px, py;
    const Kernel::PieceBounds &x, &y;
  };
  Cell cell(int px, int py) const { return {px, py, kernel_.bounds(px), kernel_.bounds(py)}; }

  void add_line_piece(Vec2 a, Vec2 b, const Cell& cell, double weight, double off_x, double off_y);
  void add_arc(const Arc& arc, bool tiny, const Rect& place);
  void add_arc_piece(const Arc& arc, bool tiny, double from, double to, int depth);
  Cell arc_cell(const Arc& arc, bool tiny, const ArcMiddle& middle, double half);
  void add_closed_form(double weight, double y0, double y1);
  double miss_of(const Arc& arc, bool tiny) const;
  CentredKnots knots_down(const Circle& c) const;

  const Kernel& kernel_;
  int line_nodes_;  // enough for straight pieces, remainder line_remainder_ per unit of |dy|
  double line_remainder_;
  double cut_error_;        // of a place where a circle is cut, from the curve or from its knot, pixels
  CentredIntegral beside_;  // in x, of the tiny circle being added
  std::vector<double> cuts_;

  Sum sum_;
  double error_ = 0;
};

}  // namespace moire
