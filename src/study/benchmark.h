// Run time against error: what each case of a study costs on this machine, beside what it errs.
//
// How the clock is kept honest: every case is warmed up once, unrecorded; then whole rounds over all cases follow, one
// per repeat, so that drift of the machine (heat, other programs) meets all cases alike and ratios are taken within a
// round; short work is done again until it takes 2 ms. Cases are timed on one thread: what threads add is measured by
// itself. Errors come from run(), on all trials, and are not timed; times are of trial 0.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>

#include "study/results.h"
#include "study/study.h"

namespace moire {

struct BenchmarkSettings {
  int repeats = 5;  // at least 1
  int threads = 0;  // the most that are tried; 0: as many as there are cores
  // Images with more samples are not rendered exhaustively. The default lets 256 x 256 pixels of 4 samples pass, with
  // any usual filter's apron. A count, not a time, so that a study gives the same columns on any machine.
  std::int64_t exhaustive_samples = 300'000;
  std::int64_t stage_samples = 5'000'000;  // likewise: the stages of images with more in their active cells
  std::int64_t least_ns = 2'000'000;       // short work is repeated until it takes that long, for each timing
};

// What a benchmark tells and asks; every function may be empty. Called between cases.
struct BenchmarkObserver {
  std::function<void(std::size_t done, std::size_t due, double share)> progress;  // visits of cases; share in (0, 1]
  std::function<bool()> stop;  // true ends the benchmark: nothing of it is whole then
};

// The tables. Only time_* columns may differ between runs of the same study, seed and build. In all tables a time X_ns
// is the median over repeats, with X_deviation_ns, X_least_ns and X_most_ns (TimingSpread) beside it.
struct Benchmark {
  BenchmarkSettings settings;
  // One per scene, layout, pattern, spp, filter and estimator, in plan order:
  //   the key; width, height, seed, n_trials; samples_total, samples_evaluated, pixels_total, pixels_active (of trial
  //   0); rmse_active, rmse_active_lo, rmse_active_hi, ci_method (over trials, 95%);
  //   of a whole image: time_setup_ns (making the pattern, or the set over the image; shared by all scenes and filters
  //   where it is a pattern), time_first_use_ns (what a first pass over the samples of the first image takes beyond a
  //   second one: sets of points that are made when they are first asked for, and caches that are cold; shared
  //   likewise; at least 0) and time_reference_ns (active pixels and exact values);
  //   per active pixel: time_generation_pixel_ns, time_evaluation_pixel_ns and time_reconstruction_pixel_ns
  //   (stage_times.h: all samples of the cells that active windows touch, in passes of their own; empty for more than
  //   stage_samples of them, and for estimators that render other pixels, too), time_render_pixel_ns (render() with
  //   all that it skips) and time_exhaustive_pixel_ns (the whole image, over the same number of pixels);
  //   time_exhaustive_sample_ns, and time_exhaustive_ratio of exhaustive to render;
  //   time_efficiency: 1 / (MSE x seconds of render per active pixel); time_front: on the Pareto front of
  //   time_render_pixel_ns and rmse_active of the scene, filter and estimator; time_exponent with _lo and _hi: of the
  //   row's series; time_repeats;
  //   exhaustive_same: whether the active pixels of the exhaustive image are the same bit for bit; empty without one.
  Table rows;
  // One per scene, layout, pattern, filter and estimator with 2 counts or more: time_exponent with time_exponent_lo and
  //   _hi, the power of spp with which time_render_pixel_ns grows over the up to 4 largest counts (power_law.h);
  //   spp_min, spp_max, n_spp.
  Table exponents;
  // One per number of threads (1, 2, 4, ... and the most): time_threads; time_render_ns, of all cases together, each
  //   as often as it takes one thread to be busy for least_ns; time_speedup over one thread with time_speedup_least,
  //   _most (over rounds).
  Table scaling;
  bool complete = true;  // false: stopped; the tables are empty
};

// Of the study's measures `error` alone is taken, and no images.
Benchmark run_benchmark(const Study& study, const BenchmarkSettings& settings, const BenchmarkObserver& observer);

// The thread counts that are tried: powers of two below `most`, and `most`.
std::vector<int> thread_steps(int most);

}  // namespace moire
