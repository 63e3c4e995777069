// Which cases of a plan are computed, when an earlier run has left rows and images.
#pragma once

#include <cstddef>
#include <vector>

#include "study/run.h"

namespace moire {

// By case, but for needs_truth. A case is due when it has no row yet, when its image is to be made, or when the last
// trial of its scene, pattern, spp, filter and estimator has no row: bias and variance over trials are found as that
// one ends, from the errors of every trial, which are kept in no file. So are its spectra: where their files are
// missing all its trials are due.
struct Schedule {
  std::vector<bool> due;
  std::vector<bool> image;        // its image is made
  std::vector<bool> moments;      // it counts for bias and variance: all its trials are due
  std::vector<bool> needs_truth;  // by scene x filters + filter: some case is due
  std::size_t due_count = 0;
};

// `earlier` as for run().
Schedule make_schedule(const Study& study, const std::vector<Case>& cases, const Table& earlier,
                       const Observer& observer);

}  // namespace moire
