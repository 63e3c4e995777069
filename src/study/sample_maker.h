// The samples of a study's cases, made when first asked for and shared by the cases that come one after another.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <tuple>

#include "engine/samples.h"
#include "study/study.h"

namespace moire {

// Cases of one pattern, count and trial must come together: what was made for the others before is forgotten.
class SampleMaker {
 public:
  explicit SampleMaker(const Study& study) : study_(study) {}

  // The samples of the case; they live until the next call for another pattern, count or trial.
  Samples samples(const Case& c) { return samples(c, study_.scenes[c.scene].image.grid()); }
  // The same for an image of another size.
  Samples samples(const Case& c, Grid grid);
  // Wall time that making the samples of the last call took, also if they were made by an earlier one.
  std::int64_t time_ns() const { return time_ns_; }

 private:
  struct Timed {
    AreaPoints points;
    std::int64_t time_ns;
  };
  const Study& study_;
  std::tuple<std::uint32_t, std::uint32_t, std::uint32_t> made_for_{};  // pattern, spp, trial
  std::optional<Pattern> pattern_;
  std::int64_t pattern_ns_ = 0, time_ns_ = 0;
  std::map<std::tuple<int, int, int, bool>, Timed> areas_;  // by width, height, apron and whether with times
};

}  // namespace moire
