// A kernel as a tiny circle sees it: knots and the antiderivative counted from the circle's centre. Both shrink with
// the circle, and so do their errors, where K and the pixel's coordinates have a floor.
#pragma once

#include <vector>

#include "filters/kernel.h"

namespace moire {

// The knots from a centre, the exact sum of `centre` and its rounding error `rest`. Those within R of it are right to
// 2 u R: two roundings of numbers below R.
struct CentredKnots {
  const Kernel& kernel;
  double centre = 0, rest = 0;

  // `knot` monotone, so that the order of knots survives its rounding.
  double from_centre(double knot) const { return (knot - centre) - rest; }
  // The piece that the point `offset` from the centre is in, -1 to kernel.pieces().
  int piece_of(double offset) const;
  // Whether that point is within `distance` of an end of the piece.
  bool near_knot(int piece, double offset, double distance) const;
};

// The integral of k from the centre to points at most `reach` from it.
class CentredIntegral {
 public:
  explicit CentredIntegral(const Kernel& kernel) : knots_{kernel} {}

  // Sums up the pieces within reach, so that a point costs a search and one quadrature.
  void place(double centre, double rest, double reach);

  const CentredKnots& knots() const { return knots_; }
  double operator()(double offset) const;  // |offset| <= reach

  // Bounds within reach: on the integral's absolute value, and on its error where `offset` errs by 8 u reach.
  double top() const { return top_; }
  double error() const { return error_; }

 private:
  double over(int piece, double from, double to) const;
  void walk(int step, double reach);

  CentredKnots knots_;
  int home_ = 0, first_ = 0;         // the pieces that hold the centre and the first point within reach
  std::vector<double> at_, before_;  // knots within reach from the centre, and the integral from the centre to them
  double top_ = 0, error_ = 0;
};

}  // namespace moire
