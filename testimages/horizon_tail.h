// The stretch of a side towards the horizon of a checkerboard, where its lines have no end: the part of the series in
// checker_series.h that is not integrated from line to line.
#pragma once

#include "testimages/board_side.h"
#include "testimages/series_side.h"

namespace moire {

// Weights are interpolated by up to this many powers of W: those of low degree exactly, others well where the stretch
// is at most kTailLength half lengths of their rectangle.
inline constexpr std::size_t kTailPowers = 8;
inline constexpr double kTailLength = 0.1;

// How near to its far end, as a share of W there, a stretch may begin for all powers of a weight of that degree along
// the side; beyond that fewer are used.
double largest_tail_start(int degree);

// The part start <= tau <= end of a side, as far as W >= 0 there, under the first terms of the weight.
struct HorizonStretch {
  const BoardSide& side;
  const SideWeight& weight;
  const SeriesTerms& terms;
  const SeriesNoise& noise;
  double start, end;
  double integral_of_w;  // a bound on it, where W is in doubt, too
};

// About what horizon_tail() leaves in doubt for a goal of 0: what powers of W miss of the weight, which takes far less
// time to know than the integral.
double tail_doubt(const HorizonStretch& stretch);

// The integral over the stretch of s(v) sum over j of g_j W^(j+1) deepest^-j E_(j+1)(u) dtau, with a guaranteed bound.
// Terms that stay below a share of `goal` by their size alone are not evaluated.
Bounded horizon_tail(const HorizonStretch& stretch, double goal);

}  // namespace moire
