// From a study to the list of its cases.
#include <fmt/format.h>

#include "core/error.h"
#include "engine/render.h"
#include "engine/samples.h"
#include "study/file_names.h"
#include "study/flat_field.h"
#include "study/noise_measures.h"
#include "study/study.h"

namespace moire {

namespace {

// Throws where the pattern cannot have n samples per pixel in the layout.
void require_samples(const Study& study, const PatternChoice& pattern, Layout layout, int n) {
  if (layout == Layout::pixel) {
    // Making one finds what the count alone does not say, such as a bank of point sets that memory cannot hold.
    Pattern(pattern, n, Draw{study.seed, 0});
    return;
  }
  std::vector<Grid> grids;
  for (const NamedScene& scene : study.scenes) grids.push_back(scene.image.grid());
  if (study.measures.has(Measure::flat_field)) grids.push_back(kFlatField);
  for (const Grid grid : grids) {
    for (const Filter& filter : study.filters) {
      pattern.area_count({grid.width + 2 * filter.apron(), grid.height + 2 * filter.apron()}, n);
    }
  }
}

}  // namespace

std::uint32_t trials_of(const Study& study, const PatternChoice& pattern) {
  return pattern.varies() ? static_cast<std::uint32_t>(study.trials) : 1;
}

std::vector<Case> plan(const Study& study) {
  std::uint64_t rows = 0;
  for (const PatternChoice& pattern : study.patterns) {
    for (const Layout layout : study.layouts) {
      for (const int n : study.spp) require_samples(study, pattern, layout, n);
    }
    rows += trials_of(study, pattern);
  }
  check_file_names(study);
  if (study.measures.has(Measure::spectrum)) {
    for (const NamedScene& scene : study.scenes) {
      const Grid grid = scene.image.grid();
      if (has_spectrum(grid)) continue;
      throw Error("measures", fmt::format("scene \"{}\" has {} x {} pixels, too many for a spectrum; give at most {} "
                                          "pixels, and {} to a side, or leave out \"spectrum\"",
                                          scene.name, grid.width, grid.height, kMaxSpectrumPixels, kMaxSpectrumSide));
    }
  }
  for (const NamedScene& scene : study.scenes) {
    for (const Filter& filter : study.filters) {
      for (const int n : study.spp) require_renderable(scene.image.grid(), filter, n, "scene \"" + scene.name + "\"");
    }
  }
  // Each factor is compared before it is multiplied, so that nothing overflows.
  for (const std::size_t factor :
       {study.scenes.size(), study.layouts.size(), study.spp.size(), study.filters.size(), study.estimators.size()}) {
    if (factor != 0 && rows > kMaxRows / factor) {
      throw Error("study", fmt::format("the plan has more than {} rows; name fewer scenes, patterns, spp, filters or "
                                       "trials",
                                       kMaxRows));
    }
    rows *= factor;
  }
  std::vector<Case> cases;
  cases.reserve(rows);
  const auto size = [](const auto& list) { return static_cast<std::uint32_t>(list.size()); };
  for (std::uint32_t scene = 0; scene < size(study.scenes); ++scene) {
    for (std::uint32_t layout = 0; layout < size(study.layouts); ++layout) {
      for (std::uint32_t pattern = 0; pattern < size(study.patterns); ++pattern) {
        const std::uint32_t trials = trials_of(study, study.patterns[pattern]);
        for (std::uint32_t spp = 0; spp < size(study.spp); ++spp) {
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
