// From a study to the list of its cases.
#include <fmt/format.h>

#include <numeric>
#include <set>
#include <utility>

#include "core/error.h"
#include "engine/render.h"
#include "engine/samples.h"
#include "study/file_names.h"
#include "study/flat_field.h"
#include "study/noise_measures.h"
#include "study/study.h"

namespace moire {

namespace {

// Throws where the pattern cannot have n samples per pixel of the scene in the layout, or no time where it needs one.
void require_samples(const Study& study, const NamedScene& scene, const PatternChoice& pattern, Layout layout, int n) {
  if (scene.image.moves()) pattern.require_time();
  if (layout == Layout::pixel) return;
  std::vector<Grid> grids = {scene.image.grid()};
  if (study.measures.has(Measure::flat_field)) grids.push_back(kFlatField);
  for (const Grid grid : grids) {
    for (const Filter& filter : study.filters) {
      pattern.area_count({grid.width + 2 * filter.apron(), grid.height + 2 * filter.apron()}, n);
    }
  }
}

// Rows of a scene; at most kMaxRows + 1.
std::uint64_t rows_of(const Study& study, std::uint32_t scene, const SceneCases& cases) {
  std::uint64_t rows = 0;
  for (const std::uint32_t pattern : cases.patterns) rows += trials_of(study, scene, pattern);
  for (const std::size_t factor :
       {cases.layouts.size(), cases.spp.size(), study.filters.size(), study.estimators.size()}) {
    // Compared before it is multiplied, so that nothing overflows.
    if (factor != 0 && rows > kMaxRows / factor) return kMaxRows + 1;
    rows *= factor;
  }
  return rows;
}

}  // namespace

SceneCases all_cases(const Study& study) {
  const auto indices = [](std::size_t n) {
    std::vector<std::uint32_t> all(n);
    std::iota(all.begin(), all.end(), 0U);
    return all;
  };
  return {indices(study.patterns.size()), indices(study.spp.size()), indices(study.layouts.size())};
}

SceneCases cases_of(const Study& study, std::size_t scene) {
  return study.scene_cases.empty() ? all_cases(study) : study.scene_cases[scene];
}

bool varies(const Study& study, std::uint32_t scene, std::uint32_t pattern) {
  return study.patterns[pattern].varies(study.scenes[scene].image.moves());
}

std::uint32_t trials_of(const Study& study, std::uint32_t scene, std::uint32_t pattern) {
  return varies(study, scene, pattern) ? static_cast<std::uint32_t>(study.trials) : 1;
}

std::vector<Case> plan(const Study& study) {
  std::set<std::pair<std::uint32_t, std::uint32_t>> made;
  std::uint64_t rows = 0;
  for (std::uint32_t i = 0; i < study.scenes.size(); ++i) {
    const SceneCases of = cases_of(study, i);
    for (const std::uint32_t pattern : of.patterns) {
      for (const std::uint32_t spp : of.spp) {
        // Making one finds what the count alone does not say, such as a bank of point sets that memory cannot hold.
        if (made.emplace(pattern, spp).second) {
          study.patterns[pattern].require_count(study.spp[spp]);
          Pattern(study.patterns[pattern], study.spp[spp], Draw{study.seed, 0});
          for (const DiscrepancyChoice& d : study.discrepancies) d.require(study.spp[spp], 2);
        }
        for (const std::uint32_t layout : of.layouts) {
          require_samples(study, study.scenes[i], study.patterns[pattern], study.layouts[layout], study.spp[spp]);
        }
      }
    }
    rows += rows_of(study, i, of);
    if (rows > kMaxRows) {
      throw Error("study", fmt::format("the plan has more than {} rows; name fewer scenes, patterns, spp, filters or "
                                       "trials",
                                       kMaxRows));
    }
  }
  check_file_names(study);
  require_spectra(study);
  for (const NamedScene& scene : study.scenes) {
    for (const Filter& filter : study.filters) {
      for (const int n : study.spp) {
        const auto require = [&](Estimator estimator) {
          require_renderable(scene.image.grid(), filter, estimator, n, "scene \"" + scene.name + "\"");
        };
        for (const EstimatorChoice& estimator : study.estimators) require(estimator.value);
        if (study.measures.has(Measure::flat_field)) require(Estimator::unnormalised);
      }
    }
  }
  std::vector<Case> cases;
  cases.reserve(rows);
  const auto size = [](const auto& list) { return static_cast<std::uint32_t>(list.size()); };
  for (std::uint32_t scene = 0; scene < size(study.scenes); ++scene) {
    const SceneCases of = cases_of(study, scene);
    for (const std::uint32_t layout : of.layouts) {
      for (const std::uint32_t pattern : of.patterns) {
        const std::uint32_t trials = trials_of(study, scene, pattern);
        for (const std::uint32_t spp : of.spp) {
          for (std::uint32_t filter = 0; filter < size(study.filters); ++filter) {
            for (std::uint32_t estimator = 0; estimator < size(study.estimators); ++estimator) {
              for (std::uint32_t trial = 0; trial < trials; ++trial) {
                cases.push_back({scene, pattern, spp, filter, estimator, trial, layout});
              }
            }
          }
        }
      }
    }
  }
  return cases;
}

std::string describe(const Study& study, const Case& c) {
  return fmt::format("{} {} {} {} {} {}{}", study.scenes[c.scene].name, study.patterns[c.pattern].text(),
                     study.spp[c.spp], study.filters[c.filter].text(), study.estimators[c.estimator].text, c.trial,
                     study.layouts[c.layout] == Layout::image ? " image" : "");
}

}  // namespace moire
