// The samples of a study's cases.
#include "study/sample_maker.h"

#include <utility>

#include "study/stopwatch.h"

namespace moire {

Samples SampleMaker::samples(const Case& c, Grid grid) {
  if (const std::tuple key(c.pattern, c.spp, c.trial); key != made_for_) {
    pattern_.reset();  // before the next one is made: a bank can be large
    areas_.clear();
    made_for_ = key;
  }
  const PatternChoice& choice = study_.patterns[c.pattern];
  const int spp = study_.spp[c.spp];
  const Draw draw{study_.seed, c.trial};
  if (study_.layouts[c.layout] == Layout::pixel) {
    if (!pattern_) {
      const Stopwatch time;
      pattern_.emplace(choice, spp, draw);
      pattern_ns_ = time.nanoseconds();
    }
    time_ns_ = pattern_ns_;
    return *pattern_;
  }
  const int apron = study_.filters[c.filter].apron();
  const bool with_time = study_.scenes[c.scene].image.moves();
  const std::tuple size(grid.width, grid.height, apron, with_time);
  auto known = areas_.find(size);
  if (known == areas_.end()) {
    const Stopwatch time;
    AreaPoints points(choice, grid, apron, spp, draw, with_time);
    known = areas_.emplace(size, Timed{std::move(points), time.nanoseconds()}).first;
  }
  time_ns_ = known->second.time_ns;
  return known->second.points;
}

}  // namespace moire
