// Running a study: from cases to rows of results.
//
// Loops: scenes in batches as memory allows; within a batch pattern, count and trial outside, scene and filter inside,
// so that a pattern with a bank of point sets makes them once for all scenes and filters.
#include "study/run.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <utility>

#include "core/error.h"
#include "core/parallel.h"
#include "measure/statistics.h"
#include "study/columns.h"
#include "study/file_names.h"
#include "study/noise_measures.h"
#include "study/optional_measures.h"
#include "study/sample_maker.h"
#include "study/schedule.h"
#include "study/stopwatch.h"

namespace moire {
namespace {

// Active pixels, over all filters, whose exact values (16 bytes) and moments over trials (16 bytes per estimator) a
// batch of scenes may hold.
constexpr std::int64_t kBatchPixels = std::int64_t{1} << 23;

// Errors of the active pixels, and the tallies of the regions. Pixels without a value of their own are exact by
// definition and only counted.
void measure(const Truth& truth, CaseResult& result) {
  const std::vector<double>& want = truth.exact.value;
  result.error.reserve(want.size());
  ErrorTally active, all, horizon;
  std::int64_t counted = 0;
  for_each_rendered(truth.rows, result.got, [&](int x, int y, Cover cover, double value) {
    ++counted;
    if (cover != Cover::partial) return all.add(x, y, value, cover == Cover::all ? 1.0 : 0.0);
    const double exact = want[result.error.size()];
    active.add(x, y, value, exact);
    if (!truth.horizon.empty() && truth.horizon[result.error.size()] != 0) horizon.add(x, y, value, exact);
    all.add(x, y, value, exact);
    result.error.push_back(value - exact);
  });
  result.active = active.finish();
  result.horizon = horizon.finish();
  all.add_exact(std::int64_t{truth.rows.grid().width} * truth.rows.grid().height - counted);
  result.all = all.finish();
}

void set_images(const Study& study, const Case& c, Row& row) {
  const bool kept = keeps_images(study, c.trial);
  const std::string stem = image_stem(study, c), exact = exact_stem(study, c.scene, c.filter);
  const auto set = [&](std::string_view name, const std::string& path) { row.set(name, kept ? Cell(path) : Cell()); };
  set("image_got", stem + ".got.exr");
  set("image_error", stem + ".error.exr");
  set("image_exact", exact + ".exact.exr");
  set("image_got_png", stem + ".got.png");
  set("image_error_png", stem + ".error.png");
  set("image_exact_png", exact + ".exact.png");
}

// Work of a case in units of samples per pixel; a case of 1 sample costs more than its sample.
double work_of(const Study& study, const Case& c) { return study.spp[c.spp] + 4.0; }

// As a file of rows holds it: numbers that are not finite are missing.
bool is_missing(const Cell& cell) {
  const auto* number = std::get_if<double>(&cell);
  return std::holds_alternative<std::monostate>(cell) || (number != nullptr && !std::isfinite(*number));
}

// Throws unless a case that was computed again gave its earlier row, times apart. Bias and variance are there only when
// all trials are computed.
void check_again(const Study& study, const Case& c, const Row& earlier, const Row& again) {
  for (const auto& [name, cell] : again.cells()) {
    const bool missing = is_missing(cell);
    if (name.starts_with("time_") || (missing && (name == "bias_sq_active" || name == "variance_active"))) continue;
    const Cell* known = earlier.find(name);
    if (known != nullptr && (*known == cell || (missing && is_missing(*known)))) continue;
    throw Error(describe(study, c),
                "its \"" + name +
                    "\" differs from that of its earlier row, now that it was computed again: that row is "
                    "from another build or was changed; remove the results and start again",
                Exit::failed);
  }
}

// Scenes [first, end) with what their cases share.
struct Batch {
  std::uint32_t end = 0;
  std::map<std::pair<std::uint32_t, std::uint32_t>, Truth> truths;  // by scene and filter
};

// Takes scenes from `first` on, at least one, until the batch is full, with active pixels or with spectra under way, or
// the run is to stop. Scenes and filters without a case that is due or an image to make are left out.
Batch make_batch(const Study& study, std::uint32_t first, const Schedule& schedule, const Observer& observer) {
  Batch batch;
  std::int64_t pixels = 0, spectra = 0;
  const auto has_room = [&] {
    if (study.measures.has(Measure::spectrum)) spectra += spectrum_bytes(study, batch.end);
    return batch.end == first || (pixels < kBatchPixels && spectra <= kMaxSpectrumBytes);
  };
  for (batch.end = first; batch.end < study.scenes.size() && has_room(); ++batch.end) {
    for (std::uint32_t filter = 0; filter < study.filters.size(); ++filter) {
      const bool image = observer.exact_image && study.images != Images::none &&
                         !(observer.has_exact_image && observer.has_exact_image(batch.end, filter));
      if (!image && !schedule.needs_truth[batch.end * study.filters.size() + filter]) continue;
      if (observer.stop && observer.stop()) return batch;
      Truth truth = find_truth(study.scenes[batch.end].image, study.filters[filter], study.accuracy);
      pixels += truth.rows.active_pixels();
      if (image) observer.exact_image(batch.end, filter, truth);
      batch.truths.emplace(std::pair(batch.end, filter), std::move(truth));
    }
  }
  return batch;
}

// Bias and variance over the trials of the cases that share a pattern and a count.
class Moments {
 public:
  // Adds a trial; after the last one of `trials` sets the columns.
  void add(const Case& c, std::uint32_t trials, CaseResult& result) {
    if (trials < 2) return;
    const auto key = std::tuple(c.layout, c.scene, c.filter, c.estimator);
    TrialMoments& moments = by_case_.try_emplace(key, result.error.size()).first->second;
    moments.add(result.error);
    if (c.trial + 1 < trials || result.error.empty()) return;
    const Split split = moments.split();
    result.row.set("bias_sq_active", split.bias_sq);
    result.row.set("variance_active", split.variance);
  }
  void clear() { by_case_.clear(); }

 private:
  std::map<std::tuple<std::uint32_t, std::uint32_t, std::uint32_t, std::uint32_t>, TrialMoments> by_case_;
};

}  // namespace

CaseResult run_case(const Study& study, const Case& c, Samples samples, std::int64_t setup_ns, const Truth& truth,
                    bool exhaustive) {
  const NamedScene& scene = study.scenes[c.scene];
  const Grid grid = scene.image.grid();
  CaseResult result;
  const Stopwatch time;
  result.got = render(scene.image, samples, study.filters[c.filter], study.estimators[c.estimator].value, truth.rows,
                      exhaustive);
  const std::int64_t render_ns = time.nanoseconds();
  measure(truth, result);

  Row& row = result.row;
  row.set("scene", scene.name);
  row.set("pattern", study.patterns[c.pattern].text());
  row.set("spp", std::int64_t{study.spp[c.spp]});
  row.set("filter", study.filters[c.filter].text());
  row.set("estimator", study.estimators[c.estimator].text);
  row.set("trial", std::int64_t{c.trial});
  row.set("layout", std::string(name_of(study.layouts[c.layout])));
  row.set("width", std::int64_t{grid.width});
  row.set("height", std::int64_t{grid.height});
  row.set("seed", static_cast<std::int64_t>(study.seed));
  row.set("samples_total", result.got.samples_total);
  row.set("samples_evaluated", result.got.samples_evaluated);
  row.set("pixels_total", std::int64_t{grid.width} * grid.height);
  row.set("pixels_active", truth.rows.active_pixels());
  row.set("fallbacks", result.got.fallbacks);
  row.set("time_setup_ns", setup_ns);
  row.set("time_render_ns", render_ns);
  row.set("time_reference_ns", truth.time_ns);
  row.set("time_threads", std::int64_t{thread_count()});
  set_errors(row, "active", result.active);
  row.set("bias_sq_active", {});
  row.set("variance_active", {});
  set_errors(row, "all", result.all);
  if (!truth.horizon.empty()) set_errors(row, "horizon", result.horizon);
  row.set("reference_method", std::string("analytic"));
  row.set("error_bound", truth.exact.max_bound);
  row.set("error_bound_rms", truth.exact.rms_bound);
  row.set("reference_limited", reference_limited(result.active.rmse, truth.exact.rms_bound));
  row.set("status", std::string("ok"));
  set_images(study, c, row);
  return result;
}

Results run(const Study& study, const std::vector<Case>& cases, const Observer& observer, Table earlier) {
  assert(earlier.empty() || earlier.size() == cases.size());
  const Schedule schedule = make_schedule(study, cases, earlier, observer);
  Table rows = std::move(earlier);
  rows.resize(cases.size());
  double work = 0, total_work = 0;
  std::size_t done = 0;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    if (schedule.due[i]) total_work += work_of(study, cases[i]);
  }
  const auto stopped = [&] { return observer.stop && observer.stop(); };
  Moments moments;
  NoiseMeasures noise(study);

  // Cases lie scene by scene, so that a batch of scenes is a stretch of the plan.
  std::size_t first = 0;
  while (first < cases.size() && !stopped()) {
    const Batch batch = make_batch(study, cases[first].scene, schedule, observer);
    if (batch.end == cases[first].scene) break;  // stopped before the first scene was ready
    std::vector<std::size_t> order;
    for (; first < cases.size() && cases[first].scene < batch.end; ++first) {
      if (schedule.due[first]) order.push_back(first);
    }
    const auto run_key = [&](std::size_t i) {
      const Case& c = cases[i];
      return std::tuple(c.pattern, c.spp, c.trial, c.layout, c.scene, c.filter, c.estimator);
    };
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return run_key(a) < run_key(b); });

    OptionalMeasures optional(study);
    SampleMaker maker(study);
    const Case* previous = nullptr;
    for (const std::size_t index : order) {
      if (stopped()) break;
      const Case& c = cases[index];
      const std::uint32_t trials = trials_of(study, c.scene, c.pattern);
      const bool same_count = previous != nullptr && previous->pattern == c.pattern && previous->spp == c.spp;
      if (!same_count) {
        moments.clear();
        noise.clear();
      }
      previous = &c;
      const Truth& truth = batch.truths.at({c.scene, c.filter});
      const Samples samples = maker.samples(c);
      CaseResult result = run_case(study, c, samples, maker.time_ns(), truth);
      optional.add(c, maker, truth, result);
      if (schedule.moments[index]) {
        moments.add(c, trials, result);
        const std::optional<Spectra> spectra = noise.add(c, trials, truth, result);
        if (spectra && observer.spectra && study.images != Images::none) observer.spectra(c, *spectra);
      }
      Row& row = rows[index];
      if (!row.cells().empty()) check_again(study, c, row, result.row);
      if (schedule.image[index]) observer.case_image(c, truth, result);
      if (row.cells().empty()) {
        row = std::move(result.row);
        if (observer.row) observer.row(row);
      }
      work += work_of(study, c);
      ++done;
      if (observer.progress) observer.progress(done, schedule.due_count, work / total_work);
    }
    moments.clear();
    noise.clear();
  }

  Results results;
  results.complete = first == cases.size() && done == schedule.due_count;
  for (Row& row : rows) {
    if (!row.cells().empty()) results.rows.push_back(std::move(row));
  }
  return results;
}

}  // namespace moire
