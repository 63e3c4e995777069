// A weight along a side, interpolated where many lines cross it: between two lines hardly anything changes, and the
// terms of a radial weight take a thousand times as long as a line.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "testimages/series_side.h"

namespace moire {

// Stretches of the side by polynomials through its values at Chebyshev points, each made when as many values have been
// asked for in its stretch as it takes. Values are asked for in order of tau.
class SideInterpolant {
 public:
  // `extent` as of SideWeight.
  SideInterpolant(std::function<void(double tau, int count, double* g)> exact, double extent);
  void at(double tau, int count, double* g);

  // What that makes of the bounds on the errors of values, for terms that are at most `top` and at complex points near
  // the side, within kBeside half lengths, at most `nearby`.
  static TermBounds error(const TermBounds& exact, const TermBounds& top, const TermBounds& nearby);

 private:
  void make(int count);

  std::function<void(double tau, int count, double* g)> exact_;
  double stretches_, current_ = -1;
  std::size_t points_;          // to a stretch: the shorter, the fewer
  int asked_ = 0, known_ = 0;   // in the current stretch: values asked for, terms interpolated
  std::vector<double> series_;  // coefficient i of term j at i kMaxTerms + j
};

}  // namespace moire
