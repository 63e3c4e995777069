// Running a study: from cases to rows of results. Nothing is written here; whoever runs a study is told of every row
// and image as it is finished.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "engine/active_rows.h"
#include "engine/exact.h"
#include "engine/render.h"
#include "measure/error.h"
#include "patterns/pattern.h"
#include "study/results.h"
#include "study/study.h"

namespace moire {

// What the cases of one scene and filter share: the active pixels and their exact values.
struct Truth {
  ActiveRows rows;
  Reference exact;
  std::vector<std::uint8_t> horizon;  // per active pixel: 1 where its window meets the horizon; empty: none does
  std::int64_t time_ns = 0;  // wall time of both
};

Truth find_truth(const TestImage& scene, const Filter& filter);

// One case: its image, its errors and its row of results.
struct CaseResult {
  Rendered got;
  std::vector<double> error;  // got - exact of the active pixels, row-major
  Errors active, all, horizon;
  Row row;
};

// Renders and measures one case of the study. `setup_ns` is the wall time that making the pattern took. The pattern
// must have the case's count and draw, and `truth` must be that of its scene and filter.
//
// Columns of the row: the key (scene, pattern, spp, filter, estimator, trial as the study writes them; width, height,
// seed); samples_total, samples_evaluated, pixels_total, pixels_active, fallbacks; time_setup_ns, time_render_ns,
// time_reference_ns, time_threads (wall times; cases that share a pattern or a reference repeat its time); the errors
// over `active` and over `all` pixels; bias_sq_active and variance_active (over trials, in the last trial's row alone,
// and only if every trial was run); reference_method, error_bound (guaranteed, absolute, the largest of the image),
// reference_limited; status; the image files, relative to the folder of the results.
CaseResult run_case(const Study& study, const Case& c, const Pattern& pattern, std::int64_t setup_ns,
                    const Truth& truth, bool exhaustive = false);

// What a run tells. Every function may be empty; all are called from the thread that runs the study.
struct Observer {
  std::function<void(const Row&)> row;  // in the order in which cases are finished
  // Images that the study's `images` setting keeps.
  std::function<void(std::uint32_t scene, std::uint32_t filter, const Truth&)> exact_image;
  std::function<void(const Case&, const Truth&, const CaseResult&)> case_image;
  std::function<void(double share)> progress;  // share of the work that is done, in (0, 1]
  std::function<bool()> stop;                  // asked before each case; true ends the run
};

struct Results {
  Table rows;  // of the cases that were run, in plan order
  bool complete = true;
};

// Runs all cases of plan(study). Exact values are found once per scene and filter, a pattern is made once per batch of
// scenes, count and trial. The rows do not depend on the order or on the number of threads, time_* apart.
Results run(const Study& study, const std::vector<Case>& cases, const Observer& observer);

}  // namespace moire
