// Files of points: the sets in them, and their discrepancy where they are small. The first byte says how many bytes
// are read at a time.
#include <algorithm>
#include <cstring>

#include "core/args.h"
#include "core/hash.h"
#include "fuzz.h"
#include "study/discrepancy_measure.h"
#include "study/point_sets.h"

using namespace moire;

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0 || size > (1 << 16)) return 0;
  return fuzz::run_target([&] {
    std::size_t at = 1;
    const std::size_t step = std::size_t{data[0]} + 1;
    const std::vector<PointSet> sets = parse_point_sets(
        [&](char* bytes, std::size_t room) {
          const std::size_t take = std::min({step, room, size - at});
          std::memcpy(bytes, data + at, take);
          at += take;
          return take;
        },
        "points");
    static const DiscrepancyChoice kMeasures[] = {DiscrepancyChoice(parse_spec("star-l2", "")),
                                                  DiscrepancyChoice(parse_spec("star-linf", "")),
                                                  DiscrepancyChoice(parse_spec("edge-l2", ""))};
    for (const PointSet& set : sets) {
      fuzz::require(!set.x.empty() && set.x.size() == set.y.size(), "a set has points");
      fuzz::require(set.t.empty() || set.t.size() == set.x.size(), "all points have a time, or none");
      if (set.x.size() > 32) continue;
      for (const DiscrepancyChoice& measure : kMeasures) {
        measure.require(static_cast<std::int64_t>(set.x.size()), 2);
        // NaN fails as well.
        fuzz::require(measure({set.x, set.y}, pixel_key(draw_hash(1, 0), {})).value >= 0, "a discrepancy is positive");
      }
    }
  });
}
