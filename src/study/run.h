// Running a study: from cases to rows of results. Nothing is written here; whoever runs a study is told of every row
// and image as it is finished.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "engine/render.h"
#include "engine/samples.h"
#include "measure/error.h"
#include "measure/spectrum.h"
#include "study/results.h"
#include "study/study.h"
#include "study/truth.h"

namespace moire {

// One case: its image, its errors and its row of results.
struct CaseResult {
  Rendered got;
  std::vector<double> error;  // got - exact of the active pixels, row-major
  Errors active, all, horizon;
  Row row;
};

// Renders and measures one case of the study. `setup_ns` is the wall time that making the samples took. The samples
// must have the case's pattern, layout, count and draw, and `truth` must be that of its scene and filter.
//
// Columns of the row: the key (scene, pattern, spp, filter, estimator, trial, layout as the study writes them; width,
// height, seed); samples_total, samples_evaluated, pixels_total, pixels_active, fallbacks; time_setup_ns,
// time_render_ns, time_reference_ns, time_threads (wall times; cases that share a pattern or a reference repeat its
// time); the errors over `active` and over `all` pixels; bias_sq_active and variance_active (over trials, in the last
// trial's row alone, and only if every trial was run); reference_method, error_bound (guaranteed, absolute, the largest
// of the image), error_bound_rms, reference_limited; status; the image files, relative to the folder of the results.
// run() adds those of optional_measures.h and noise_measures.h.
CaseResult run_case(const Study& study, const Case& c, Samples samples, std::int64_t setup_ns, const Truth& truth,
                    bool exhaustive = false);

// What a run tells and asks. Every function may be empty; all are called from the thread that runs the study.
struct Observer {
  std::function<void(const Row&)> row;  // in the order in which cases are finished; not for rows that were there
  // Images that the study's `images` setting keeps.
  std::function<void(std::uint32_t scene, std::uint32_t filter, const Truth&)> exact_image;
  std::function<void(const Case&, const Truth&, const CaseResult&)> case_image;
  // The spectra of a case's errors, after its last trial, where the study measures and keeps them.
  std::function<void(const Case& last, const Spectra&)> spectra;
  // Whether such images are there already: then they are not made. Empty: none are. The second is asked only for
  // cases whose row is there; the images of others are made with it.
  std::function<bool(std::uint32_t scene, std::uint32_t filter)> has_exact_image;
  std::function<bool(const Case&)> has_case_image;
  std::function<bool(const Case& last)> has_spectra;
  std::function<void(std::size_t done, std::size_t due, double share)> progress;  // cases; share of the work, in (0, 1]
  std::function<bool()> stop;  // asked before each case; true ends the run
};

struct Results {
  Table rows;  // of the cases that are finished, in plan order
  bool complete = true;
};

// Runs all cases of plan(study). Exact values are found once per scene and filter, a pattern is made once per batch of
// scenes, count and trial. The rows do not depend on the order or on the number of threads, time_* apart.
//
// `earlier` are rows of the same study from a run that was stopped: one per case, without cells where there is none; or
// no rows at all. They are kept as they are, and only the other cases are run, so that the results, time_* apart, are
// those of a run that was never stopped. Some cases with rows are computed again all the same: those whose image is
// missing, and the trials of a case of which the last is missing, since bias and variance need the errors of them all.
// If such a result is not that of the row, time_* apart, Error (Exit::failed): then `earlier` is not of this study and
// build.
Results run(const Study& study, const std::vector<Case>& cases, const Observer& observer, Table earlier = {});

}  // namespace moire
