// An experiment as a value: what a study file says, checked, and its plan. Everything that can be refused is refused
// here, before anything is computed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "engine/render.h"
#include "filters/filter.h"
#include "measure/contrast_sensitivity.h"
#include "measure/spectrum.h"
#include "patterns/pattern.h"
#include "study/discrepancy_measure.h"
#include "study/measures.h"
#include "study/scene_file.h"
#include "testimages/testimage.h"

namespace moire {

// Limits of a study. The scenes of all ranges; the rows of the plan, which are held in memory (a few kB each); trials;
// the study's text with those of the files that it names, which results.jsonl begins with; and the pixels of an image
// that is written to a file (it is then held densely in memory). Lists have theirs in lists.h, files in text_file.h.
inline constexpr std::size_t kMaxScenes = 100'000;
inline constexpr std::size_t kMaxRows = 1'000'000;
inline constexpr int kMaxTrials = 1'000'000;
inline constexpr std::size_t kMaxStudyBytes = std::size_t{64} << 20;
inline constexpr std::int64_t kMaxImagePixels = std::int64_t{1} << 28;

struct EstimatorChoice {
  explicit EstimatorChoice(Estimator estimator) : text(name_of(estimator)), value(estimator) {}
  std::string text;  // as rows and file names have it: one for each estimator and form
  Estimator value;
};

// How spectra of errors are taken: a table [spectrum] of a study file.
struct SpectrumSettings {
  SpectrumWindow window = SpectrumWindow::none;
  double pixels_per_degree = kPixelsPerDegree;  // of the eye's field, for csf_rms; 1 to 1000
};

// Of which cases the images are kept.
enum class Images : std::uint8_t { none, first_trial, all };

// Which of the study's lists a scene goes with: indices into them, all of them unless its table says otherwise.
struct SceneCases {
  std::vector<std::uint32_t> patterns, spp, layouts;
};

// The defaults are those of a study file. Patterns and scenes have none; spp, filters and estimators are filled in by
// parse_study: 1, 4, 16, 64 and 256; box; ratio; error.
struct Study {
  std::string name;        // default: the file's name without .toml
  std::string text;        // the study file, followed by the kernel and scene files that it names
  std::uint64_t seed = 1;  // names the experiment
  int trials = 8;          // replicates t = 0 .. trials - 1 of patterns that vary
  std::vector<Layout> layouts = {Layout::pixel};
  std::vector<int> spp;
  std::vector<PatternChoice> patterns;
  std::vector<Filter> filters;
  std::vector<EstimatorChoice> estimators;
  MeasureSet measures;
  std::vector<DiscrepancyChoice> discrepancies;  // of the patterns' sets, beside the errors
  SpectrumSettings spectrum;
  Images images = Images::first_trial;
  WeightAim accuracy;  // of the exact values
  std::vector<NamedScene> scenes;
  std::vector<SceneCases> scene_cases;  // of each scene; none at all: every scene with everything
};

// Reads a study. `file` is what messages call it and the folder that `file = "scene.toml"` starts from; `stem` is the
// default name. Throws Error with file:line:column.
Study parse_study(std::string_view text, const std::string& file, const std::string& stem);

// Everything, and what the scene goes with.
SceneCases all_cases(const Study& study);
SceneCases cases_of(const Study& study, std::size_t scene);

// Whether the pattern's points differ from trial to trial on the scene: of moving ones their times, too.
bool varies(const Study& study, std::uint32_t scene, std::uint32_t pattern);
// Trials that are run of them: the study's, or one.
std::uint32_t trials_of(const Study& study, std::uint32_t scene, std::uint32_t pattern);

// One image to compute: indices into the study's lists, and the trial.
struct Case {
  std::uint32_t scene = 0, pattern = 0, spp = 0, filter = 0, estimator = 0, trial = 0, layout = 0;
  friend bool operator==(const Case&, const Case&) = default;
};

// Every case in the order scene, layout, pattern, spp, filter, estimator, trial, the last one fastest. A pattern that
// does not vary has trial 0 alone. Throws Error when a pattern cannot have a count, naming the nearest ones, and when
// the plan is too long.
std::vector<Case> plan(const Study& study);

// The key of a case on one line: scene, pattern, spp, filter, estimator and trial, separated by blanks; then the layout
// if it is not `pixel`.
std::string describe(const Study& study, const Case& c);

}  // namespace moire
