// L2 discrepancies by Monte Carlo: what D. P. Mitchell, "Ray tracing and irregularities of distribution", 1992, did,
// and the check of the closed forms.
//
// A test is a region; D is the share of the points in it less its area, and T_N^2 the mean of D^2 over tests. Tests are
// hashes of (key, index): the same for every set of points, in the same order whatever the number of threads. Their key
// may be that of the pattern's points: they have axes of their own. O(tests * N) time.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "core/hash.h"
#include "measure/discrepancy/line_law.h"
#include "measure/discrepancy/point_view.h"
#include "measure/discrepancy/test_lines.h"

namespace moire {

struct MonteCarlo {
  double mean_square = 0;     // estimate of T_N^2
  double standard_error = 0;  // of mean_square; 0 for a single test
};

// Which points are counted; the number of points that the count is divided by is N in any case.
enum class Counted : std::uint8_t {
  all,
  without_first  // not point 0 of the set: how the numbers of Mitchell's Table 4 seem to have come about
};

// For all: tests >= 1.

// Boxes [0, x) x [0, y), and x [0, t) where points have a t, their upper corner uniform.
MonteCarlo star_l2_monte_carlo(const PointView& points, std::int64_t tests, const Key& key,
                               Counted counted = Counted::all);

// The sides above random lines that hit the unit square (test_lines.h). t is not looked at.
MonteCarlo edge_l2_monte_carlo(const PointView& points, LineLaw law, std::int64_t tests, const Key& key,
                               Counted counted = Counted::all);

// The same with lines that were drawn before, at least one: for all `lines` of a law and a key, the same bits.
MonteCarlo edge_l2_monte_carlo(const PointView& points, std::span<const MeasuredLine> lines,
                               Counted counted = Counted::all);

// Disks on the unit torus: centre uniform, radius as given in (0, 1/2], or uniform in [0, 1/2]. t is not looked at.
MonteCarlo disk_l2_monte_carlo(const PointView& points, std::optional<double> radius, std::int64_t tests,
                               const Key& key, Counted counted = Counted::all);

}  // namespace moire
