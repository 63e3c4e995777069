// What the cases of one scene and filter share: the active pixels and their exact values.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/active_rows.h"
#include "engine/exact.h"
#include "filters/filter.h"
#include "testimages/testimage.h"

namespace moire {

struct Truth {
  ActiveRows rows;
  Reference exact;
  std::vector<std::uint8_t> horizon;  // per active pixel: 1 where its window meets the horizon; empty: none does
  std::int64_t time_ns = 0;           // wall time of both
};

Truth find_truth(const TestImage& scene, const Filter& filter, const WeightAim& aim = {});

}  // namespace moire
