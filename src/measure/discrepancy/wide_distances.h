// Sums of distances with AVX-512, whose square roots are not the machine's.
#pragma once

#include "core/double_double.h"
#include "core/instruction_sets.h"
#include "measure/discrepancy/pair_sum.h"

#if MOIRE_HAS_AVX
namespace moire {

// The sum over all i of `rows` and j of `columns` of the distance |p_i - p_j|: the bits of the loops that
// edge_pairs.cpp has for other machines. Blocks of at most kPairBlock points; needs AVX-512, F and DQ.
Dd distances_avx512(PairBlock rows, PairBlock columns);

}  // namespace moire
#endif
