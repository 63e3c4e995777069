// L-infinity discrepancy of edges, D_N: the least upper bound of |share of the points in a half-plane - area of its
// part of the unit square| over all half-planes. Exact, in the manner of Dobkin, Eppstein and Mitchell, "Computing the
// discrepancy with applications to supersampling patterns", ACM Transactions on Graphics 15(4), 1996; by sorting about
// each point, without their dual arrangement.
#pragma once

#include "measure/discrepancy/point_view.h"

namespace moire {

// D_N, in (0, 1]; points.t is not looked at. All decisions (which points are on a line, and on which side of it) are
// exact for the stored doubles that are 0 or at least 2^-984, areas have 100 bits: the result is within an ulp.
// O(N^2 log N) time (one core: 256 points 6 ms, 1,600 points 0.3 s), O(N) memory. The same bits for any order of the
// points and any number of threads.
double edge_linf(const PointView& points);

}  // namespace moire
