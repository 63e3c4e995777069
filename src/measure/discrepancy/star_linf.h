// The star discrepancy, D_N, of points of the unit square: the least upper bound of |share of the points in a box -
// area of the box| over all boxes [0, x) x [0, y). Exact, after Bundschuh and Zhu, "A method for exact calculation of
// the discrepancy of low-dimensional finite point sets I", Abh. Math. Sem. Univ. Hamburg 63, 1993.
#pragma once

#include "measure/discrepancy/point_view.h"

namespace moire {

// D_N, in (0, 1]; t is not looked at. The least upper bound counts closed and open boxes: one point at the origin
// gives 1. Error below 2^-51: each box's value is rounded three times. O(N^2) time (1,600 points: 2 ms), O(N) memory.
double star_linf(const PointView& points);

}  // namespace moire
