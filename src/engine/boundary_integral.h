// One boundary integral for every separable filter: the integral of k(x) k(y) over a plane set equals the closed
// integral of K(x) k(y) dy over its boundary (Green), K the antiderivative of k from the left end of its support.
//
// The curves need no clipping: pieces left of the support contribute nothing (K = 0), pieces right of it their K(y)
// difference (K = 1), pieces above and below it nothing (k = 0). Inside, pieces are cut at the kernel's knots, where K
// and k change their formula, and integrated by Gauss-Legendre quadrature with a proven remainder.
#pragma once

#include <vector>

#include "core/sum.h"
#include "curve/boundary.h"
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
  // Guaranteed bound on |value() - integral over the described curves|: rounding, quadrature and kernel fit.
  double bound() const;

 private:
  struct ArcFrame;
  void add_segment_piece(const Segment& s, double from, double to);
  void add_arc(const ArcFrame& arc);
  void add_arc_piece(const ArcFrame& arc, double from, double to, int depth);
  void add_closed_form(double weight, double y0, double y1);
  double delta_K(const Circle& c, double xi) const;

  const Kernel& kernel_;
  int line_nodes_;  // enough for straight pieces, remainder line_remainder_ per unit of |dy|
  double line_remainder_;
  double position_error_;  // of a computed point on a curve, pixels
  double per_length_;      // bound on the integrand's error, per unit of |dy|
  double per_cut_;         // error of a cut that misses its knot by position_error_
  std::vector<double> cuts_;

  Sum sum_;
  double length_ = 0;  // total |dy| of integrated pieces
  double other_ = 0;   // bounds that are not proportional to length
  int cuts_made_ = 0;
};

}  // namespace moire
