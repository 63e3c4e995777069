// Run time against error.
#include "study/benchmark.h"

#include <algorithm>
#include <cassert>
#include <cstring>
#include <map>
#include <optional>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "core/parallel.h"
#include "measure/statistics.h"
#include "study/benchmark_rows.h"
#include "study/run.h"
#include "study/sample_maker.h"
#include "study/stage_times.h"
#include "study/stopwatch.h"
#include "study/truth.h"

namespace moire {
namespace {

constexpr int kMaxLoops = 1000;  // of short work

// One case: what it is, how often it is repeated within a timing, and its timings.
struct BenchmarkCase {
  Case c;
  int loops = 1, stage_loops = 1, exhaustive_loops = 1;
  bool stages = false, exhaustive = false;  // timed by stage, and exhaustively
  double latest_ns = 0;                     // render() in this round
  std::optional<bool> same;                 // whether the exhaustive image's active pixels are
  CaseTimings timings;
  Row row;
};

// What the cases of a scene and filter share.
struct TimedTruth {
  std::optional<ActiveRows> rows;
  std::optional<ActiveCells> cells;
  std::vector<double> timings;  // of the active pixels and their exact values
};

std::vector<double> active_values(const ActiveRows& rows, const Rendered& rendered) {
  std::vector<double> values;
  for_each_rendered(rows, rendered, [&](int, int, Cover cover, double value) {
    if (cover == Cover::partial) values.push_back(value);
  });
  return values;
}

// Estimators that render other pixels, too, need other cells than time_stages() goes through, and importance estimators
// have samples of their own.
bool has_stages(Estimator estimator) {
  return rendered_pixels(estimator, false) == Pixels::active && !is_importance(estimator);
}

// Nanoseconds of one call of f, the mean of `loops`.
template <class F>
double timed(int loops, F&& f) {
  const Stopwatch time;
  for (int i = 0; i < loops; ++i) f();
  return static_cast<double>(time.nanoseconds()) / loops;
}

// The study as it is benchmarked: errors and nothing else.
Study bare_study(const Study& study) {
  Study bare = study;
  bare.measures = {};
  bare.measures.add(Measure::error);
  bare.discrepancies.clear();
  bare.images = Images::none;
  return bare;
}

// A row without its times: the key and the counts of the first trial's row, and the errors over trials.
Row error_row(const Row& first, std::span<const double> mse) {
  Row row;
  const auto copy = [&](const char* name) { row.set(name, *first.find(name)); };
  for (const char* name : {"scene", "layout", "pattern", "spp", "filter", "estimator", "width", "height", "seed"}) {
    copy(name);
  }
  row.set("n_trials", static_cast<std::int64_t>(mse.size()));
  for (const char* name : {"samples_total", "samples_evaluated", "pixels_total", "pixels_active"}) copy(name);
  const std::optional<Interval> interval = rms_interval(mse);
  row.set("rmse_active", finite_cell(rms_over_trials(mse)));
  row.set("rmse_active_lo", interval ? Cell(interval->lo) : Cell());
  row.set("rmse_active_hi", interval ? Cell(interval->hi) : Cell());
  row.set("ci_method", interval ? Cell(std::string(kRmsMethod)) : Cell());
  return row;
}

class Bench {
 public:
  Bench(const Study& study, const BenchmarkSettings& settings, const BenchmarkObserver& observer)
      : study_(bare_study(study)), settings_(settings), observer_(observer), plan_(plan(study_)) {
    const ThreadLimit all(settings.threads);
    steps_ = thread_steps(thread_count());
    sweep_ns_.resize(steps_.size());
    for (const Case& c : plan_) work_due_ += work_of(c) + (c.trial == 0 ? rounds() * work_of(c) : 0);
    for (const Case& c : plan_) visits_due_ += 1 + (c.trial == 0 ? static_cast<std::size_t>(rounds()) : 0);
  }

  Benchmark run() {
    Benchmark out;
    out.settings = settings_;
    out.complete = find_errors();
    for (int round = 0; out.complete && round < rounds(); ++round) out.complete = visit_all(round);
    if (!out.complete) return out;
    for (BenchmarkCase& b : cases_) {
      b.timings.reference = truths_.at({b.c.scene, b.c.filter}).timings;
      set_case_times(b.row, b.timings);
      b.row.set("time_repeats", std::int64_t{settings_.repeats});
      b.row.set("exhaustive_same", b.same ? Cell(*b.same) : Cell());
      out.rows.push_back(std::move(b.row));
    }
    mark_fronts(out.rows);
    out.exponents = fit_exponents(out.rows);
    for (std::size_t i = 0; i < steps_.size(); ++i) {
      Row row;
      row.set("time_threads", std::int64_t{steps_[i]});
      set_timings(row, "time_render_ns", sweep_ns_[i]);
      set_ratio(row, "time_speedup", sweep_ns_[0], sweep_ns_[i]);
      out.scaling.push_back(std::move(row));
    }
    return out;
  }

 private:
  // Round 0 warms up and is not recorded.
  int rounds() const { return settings_.repeats + 1; }
  bool stop() const { return observer_.stop && observer_.stop(); }
  double work_of(const Case& c) const { return study_.spp[c.spp] + 4.0; }

  void step(const Case& c) {
    work_done_ += work_of(c);
    ++visits_done_;
    if (observer_.progress) observer_.progress(visits_done_, visits_due_, work_done_ / work_due_);
  }

  // Runs the study for its errors, and lists the cases; false when it was stopped.
  bool find_errors() {
    const ThreadLimit all(settings_.threads);
    Observer observer;
    observer.stop = observer_.stop;
    std::size_t known = 0;
    observer.row = [&](const Row&) { step(plan_[known++]); };
    const Results results = moire::run(study_, plan_, observer);
    if (!results.complete) return false;
    for (std::size_t i = 0; i < plan_.size();) {
      BenchmarkCase b;
      b.c = plan_[i];
      const Row& first = results.rows[i];
      std::vector<double> mse;
      do {
        mse.push_back(results.rows[i++].number("mse_active"));
      } while (i < plan_.size() && plan_[i].trial != 0);
      b.row = error_row(first, mse);
      b.exhaustive = b.row.number("samples_total") <= static_cast<double>(settings_.exhaustive_samples);
      truths_.try_emplace({b.c.scene, b.c.filter});
      cases_.push_back(std::move(b));
      order_.push_back(order_.size());
    }
    // A pattern of one count is made once for all scenes and filters.
    const auto key = [&](std::size_t i) {
      const Case& c = cases_[i].c;
      return std::tuple(c.pattern, c.spp, c.layout, c.scene, c.filter, c.estimator);
    };
    std::sort(order_.begin(), order_.end(), [&](std::size_t a, std::size_t b) { return key(a) < key(b); });
    return true;
  }

  // One round over everything; false when it was stopped.
  bool visit_all(int round) {
    for (auto& [key, timed_truth] : truths_) {
      if (stop()) return false;
      find_reference(key.first, key.second, round, timed_truth);
    }
    std::vector<double> sweep(steps_.size());
    double first_use_ns = 0;
    SampleMaker maker(study_);  // of this round: in each, samples are made again
    for (std::size_t begin = 0, end = 0; begin < order_.size(); begin = end) {
      const Case& first = cases_[order_[begin]].c;
      const auto is_other = [&](std::size_t i) {
        return cases_[i].c.pattern != first.pattern || cases_[i].c.spp != first.spp;
      };
      end = static_cast<std::size_t>(
          std::find_if(order_.begin() + static_cast<std::ptrdiff_t>(begin), order_.end(), is_other) - order_.begin());
      for (std::size_t s = 0; s < steps_.size(); ++s) {
        const ThreadLimit limit(steps_[s]);
        for (std::size_t i = begin; i < end; ++i) {
          if (stop()) return false;
          BenchmarkCase& b = cases_[order_[i]];
          const Samples samples = maker.samples(b.c);
          if (s == 0) {
            const double use_ns = use_first(b, samples, i == begin);
            if (i == begin) first_use_ns = use_ns;
            if (round > 0) b.timings.setup.push_back(static_cast<double>(maker.time_ns()));
            if (round > 0) b.timings.first_use.push_back(first_use_ns);
            visit(b, samples, round);
          }
          // The first step is one thread, which the visit has timed.
          const double ns = s == 0 ? b.latest_ns : timed(b.loops, [&] { render_case(b.c, samples, false); });
          sweep[s] += ns * b.loops;
        }
      }
    }
    for (std::size_t s = 0; round > 0 && s < steps_.size(); ++s) sweep_ns_[s].push_back(sweep[s]);
    return true;
  }

  void find_reference(std::uint32_t scene, std::uint32_t filter, int round, TimedTruth& to) const {
    const ThreadLimit one(1);
    Truth truth = find_truth(study_.scenes[scene].image, study_.filters[filter], study_.accuracy);
    if (round > 0) return to.timings.push_back(static_cast<double>(truth.time_ns));
    to.cells.emplace(truth.rows, study_.filters[filter].apron());
    to.rows.emplace(std::move(truth.rows));
  }

  Rendered render_case(const Case& c, const Samples& samples, bool exhaustive) const {
    return render(study_.scenes[c.scene].image, samples, study_.filters[c.filter], study_.estimators[c.estimator].value,
                  *truths_.at({c.scene, c.filter}).rows, exhaustive);
  }

  // Times one case on the threads there are; in round 0 finds how often short work is repeated, and compares.
  void visit(BenchmarkCase& b, const Samples& samples, int round) {
    step(b.c);
    if (round == 0) warm_up(b, samples);
    b.latest_ns = timed(b.loops, [&] { render_case(b.c, samples, false); });
    if (round == 0) return;
    b.timings.render.push_back(b.latest_ns);
    if (b.stages) {
      StageTimes sum;
      for (int i = 0; i < b.stage_loops; ++i) {
        const StageTimes times = stages(b.c, samples);
        sum.generation_ns += times.generation_ns;
        sum.evaluation_ns += times.evaluation_ns;
        sum.reconstruction_ns += times.reconstruction_ns;
      }
      b.timings.generation.push_back(static_cast<double>(sum.generation_ns) / b.stage_loops);
      b.timings.evaluation.push_back(static_cast<double>(sum.evaluation_ns) / b.stage_loops);
      b.timings.reconstruction.push_back(static_cast<double>(sum.reconstruction_ns) / b.stage_loops);
    }
    if (b.exhaustive) {
      b.timings.exhaustive.push_back(timed(b.exhaustive_loops, [&] { render_case(b.c, samples, true); }));
    }
  }

  // Whether a pass over all samples of the active cells takes no longer than it may.
  bool few_samples(const BenchmarkCase& b, const Samples& samples) const {
    const double cells = static_cast<double>(truths_.at({b.c.scene, b.c.filter}).cells->size());
    return cells * samples.density() <= static_cast<double>(settings_.stage_samples);
  }

  // Makes all samples of the active cells, so that no timing meets sets of points that are made when first asked for;
  // of samples that are new, `measured`, twice: what the first time took beyond the second. Of others only where it is
  // quick.
  double use_first(const BenchmarkCase& b, const Samples& samples, bool measured) const {
    const auto make_all = [&] {
      return static_cast<double>(
          time_generation(samples, *truths_.at({b.c.scene, b.c.filter}).cells, study_.scenes[b.c.scene].image.moves()));
    };
    if (!measured && !few_samples(b, samples)) return 0;
    const double first_ns = make_all();
    return measured ? std::max(0.0, first_ns - make_all()) : 0;
  }

  StageTimes stages(const Case& c, const Samples& samples) const {
    return time_stages(study_.scenes[c.scene].image, samples, study_.filters[c.filter],
                       *truths_.at({c.scene, c.filter}).cells);
  }

  void warm_up(BenchmarkCase& b, const Samples& samples) const {
    const auto loops = [&](const Stopwatch& time) {
      return static_cast<int>(
          std::clamp<std::int64_t>(settings_.least_ns / std::max<std::int64_t>(1, time.nanoseconds()), 1, kMaxLoops));
    };
    const Stopwatch time;
    const Rendered got = render_case(b.c, samples, false);
    b.loops = loops(time);
    b.stages = has_stages(study_.estimators[b.c.estimator].value) && few_samples(b, samples);
    if (b.stages) {
      const Stopwatch stage_time;
      stages(b.c, samples);
      b.stage_loops = loops(stage_time);
    }
    if (!b.exhaustive) return;
    const Stopwatch exhaustive_time;
    const Rendered all = render_case(b.c, samples, true);
    b.exhaustive_loops = loops(exhaustive_time);
    const ActiveRows& rows = *truths_.at({b.c.scene, b.c.filter}).rows;
    const std::vector<double> a = active_values(rows, got), e = active_values(rows, all);
    b.same = a.size() == e.size() && (a.empty() || std::memcmp(a.data(), e.data(), a.size() * sizeof(double)) == 0);
  }

  Study study_;
  BenchmarkSettings settings_;
  const BenchmarkObserver& observer_;
  std::vector<Case> plan_;
  std::vector<int> steps_;                                                // numbers of threads
  std::vector<std::vector<double>> sweep_ns_;                             // of all cases together, by step and round
  std::vector<BenchmarkCase> cases_;                                      // in plan order
  std::vector<std::size_t> order_;                                        // of visits
  std::map<std::pair<std::uint32_t, std::uint32_t>, TimedTruth> truths_;  // by scene and filter
  double work_done_ = 0, work_due_ = 0;
  std::size_t visits_done_ = 0, visits_due_ = 0;
};

}  // namespace

std::vector<int> thread_steps(int most) {
  std::vector<int> steps;
  for (int n = 1; n < most; n *= 2) steps.push_back(n);
  steps.push_back(std::max(1, most));
  return steps;
}

Benchmark run_benchmark(const Study& study, const BenchmarkSettings& settings, const BenchmarkObserver& observer) {
  assert(settings.repeats >= 1);
  return Bench(study, settings, observer).run();
}

}  // namespace moire
