// The L2 star discrepancy, T_N, of points of the unit square or cube, by closed form.
//
// T_N^2 is the mean over all boxes [0, x) x [0, y) (x [0, t)), their upper corner uniform, of the square of
//   (share of the points in the box) - (volume of the box).
// Warnock, "Computational investigations of low-discrepancy point sets", 1972:
//   T_N^2 = 3^-k - (2^(1-k) / N) sum_i prod_d (1 - x_id^2) + (1 / N^2) sum_ij prod_d (1 - max(x_id, x_jd)).
// The double sum by divide and conquer on one coordinate after the other, after Heinrich, "Efficient algorithms for
// computing the L2-discrepancy", Math. Comp. 65, 1996: O(N log N) time in 2-D, O(N log^2 N) in 3-D, O(N) memory.
//
// Accuracy. The three terms, of order 0.1, cancel down to T^2 of order (log N)^(k-1) / N^2, so all is done with 106
// bits. For the stored doubles: |error of T^2| < (N + 100) 2^-103 plus half an ulp, from at most N roundings of 3
// 2^-106 in a row in each of two sums of positive terms below N^2, divided by N^2. Measured against 113-bit arithmetic,
// Zaremba's points, N = 1 to 10^5, 2-D and 3-D: T^2 is correctly rounded, so that all 15 digits of T hold. A coordinate
// that was rounded before it was stored, like i / N, counts as moved: all k N of them by at most d change T^2 by at
// most 2 k d D_N with D_N the star discrepancy (the derivative is -2/N times an integral of the local discrepancy). For
// Zaremba's points at N = 10^5 and d = 2^-54 that leaves 10 digits of T in the worst case.
#pragma once

#include "measure/discrepancy/point_view.h"

namespace moire {

// T_N^2, in (0, 1]. The order of the points changes no bit. On one core half a second for 10^6 points in 2-D, and for
// 10^5 in 3-D.
double star_l2_squared(const PointView& points);

}  // namespace moire
