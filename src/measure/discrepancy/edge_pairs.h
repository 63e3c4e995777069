// What all pairs of points contribute to the L2 discrepancies of edges: the inner loops, which want wide vectors.
#pragma once

#include <span>

#include "measure/discrepancy/line_law.h"
#include "measure/discrepancy/pair_sum.h"

namespace moire {

// The sum over all i of `rows` and j of `columns` of (isotropic) the distance |p_i - p_j| or (printed) the probability
// h that the line separates them. Blocks of at most kPairBlock points.
using PairTile = Dd (*)(PairBlock rows, PairBlock columns);

// The loops that this machine can run, the widest vectors last; all give the same bits. The error of each term is below
// 3 u of it for distances and below 8 u for h.
std::span<const PairTile> edge_pair_tiles(LineLaw law);

}  // namespace moire
