// What the mean of T_N^2 over all draws of a pattern is: closed forms, correct to 1e-14 relative.
//
// A pattern's points are each uniform. Where they are independent (random, jittered), the mean of T^2 is the mean over
// tests of sum_i q_i (1 - q_i) / N^2, with q_i the share of point i's region (the square, or its cell) that the test
// covers. For points that depend on each other in pairs (N-rooks), the mean follows from the law of one pair. Each is
// an expectation of T^2, not of T: compare sqrt with the RMS over trials.
//
// n is at least 1, and the square of an integer for jittered points.
#pragma once

#include <cstdint>
#include <optional>

#include "measure/discrepancy/line_law.h"

namespace moire {

// Random points, dims = 2 or 3: (2^-k - 3^-k) / N.
double expected_star_l2_squared_random(std::int64_t n, int dims);
// Jittered points, dims = 2; with dims = 3, jittered points with an independent random time each.
double expected_star_l2_squared_jittered(std::int64_t n, int dims = 2);
double expected_star_l2_squared_n_rooks(std::int64_t n);

// Lines through the square (test_lines.h).
double expected_edge_l2_squared_random(std::int64_t n, LineLaw law);
double expected_edge_l2_squared_jittered(std::int64_t n, LineLaw law);
double expected_edge_l2_squared_n_rooks(std::int64_t n, LineLaw law);

// Disks on the torus: E[A (1 - A)] / N for the disk's area A. The radius is fixed in (0, 1/2], or uniform in [0, 1/2].
double expected_disk_l2_squared_random(std::int64_t n, std::optional<double> radius);

}  // namespace moire
