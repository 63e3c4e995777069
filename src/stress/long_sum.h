// The compensated sum over more terms than would fit into memory.
#pragma once

#include <cstdint>

#include "stress/family.h"

namespace moire::stress {

// `terms` terms up to 2^53 in size, which cancel within blocks of 2^20 but for a whole number below 1024 of each pair:
// a condition number of about 2^44. Exact in integers. The bound is one rounding of the sum, which holds for up to 2^32
// terms. Some 8 ns a term.
Outcome long_sum(std::uint64_t terms, CaseKey key);

}  // namespace moire::stress
