// L2 discrepancy of disks on the unit torus: how far the share of the points in a random disk is from its area, in the
// mean square over centres uniform on the torus. By closed form: two points share a disk of radius r as often as the
// disks of radius r around them, and around all their periodic images, have area in common.
#pragma once

#include "measure/discrepancy/point_view.h"

namespace moire {

// T_N^2 = E[(count / N - area)^2] with the radius uniform in [0, 1/2]; points.t is not looked at. Absolute error below
// 1e-15 for any points and any N: four images with overlaps to 5e-16, a quarter of them, and the rounding of a mean
// that is pi^2 / 80 or little more, 20 u. Measured: below 1e-16. The result can be negative by as much.
//
// O(N^2) time (one core with AVX-512: 5 ns a pair, N = 1,600 6 ms, N = 16,384 0.7 s; with AVX2 9 ns, without 14 ns a
// pair), O(N) memory; the bits depend neither on threads nor on the machine's vectors.
double disk_l2_squared(const PointView& points);

// The same for disks of one radius, 2^-500 < radius <= 1/2. Absolute error below 3e-15, for R = 1/2: four overlaps to
// 1e-15, a quarter of them, and 20 u of a mean of about pi^2 / 16. It shrinks with R^2, but for 1.6e-16 R times the share
// of pairs that meet across a side of the square: 1 less their difference is right to 2^-54, where coordinates have
// more digits than 53 behind the point. Radii up to 1/4, for which one image will do, take a third of the time.
double disk_l2_squared(const PointView& points, double radius);

}  // namespace moire
