// How a side of series_side.h is integrated: from line to line up to where, and the rest, towards the horizon, in how
// many stretches. Its file has lay_out() and outlook(), too.
#pragma once

#include "testimages/board_side.h"
#include "testimages/series_side.h"

namespace moire {

// What is integrated between lines begins at side.from; the rest is cut into so many equal stretches.
struct SidePlan {
  BoardSide side;
  double stretches, doubt;  // what integrals over the stretches leave in doubt, about, without C / det
};

// For a side that has been laid out: a plan that leaves no more than `share` in doubt, if there is one; quick: of those
// that are never long in coming.
SidePlan plan_side(const BoardSide& side, const SideWeight& weight, const SeriesTerms& terms, const SeriesNoise& noise,
                   double share, bool quick);

// The integral over the stretches, without C / det, to about `goal`.
Bounded integrate_rest(const SidePlan& plan, const SideWeight& weight, const SeriesTerms& terms,
                       const SeriesNoise& noise, double goal);

}  // namespace moire
