// The measures that a study names beyond `error`, as columns of its rows, with what cases share kept between them.
#pragma once

#include <cstdint>
#include <map>
#include <tuple>
#include <utility>

#include "measure/excursion.h"
#include "study/coverage.h"
#include "study/discrepancy_measure.h"
#include "study/run.h"
#include "study/sample_maker.h"

namespace moire {

class OptionalMeasures {
 public:
  explicit OptionalMeasures(const Study& study) : study_(study) {}

  // Adds the columns of the measures that the study names; nothing is computed for others.
  //   coverage: n_pixels, bias, mse, rmse and max_abs of got - coverage (_coverage_active, _coverage_all) and of exact
  //     - coverage (_filter_active, _filter_all). Coverage is the box filter's exact value; `active` are the pixels
  //     that are active under the filter or under the box.
  //   flat-field: flat_field_rms (flat_field.h), the same for all scenes and estimators.
  //   ringing: overshoot, undershoot and ringing_rms (measure/excursion.h, over all pixels), each _got and _exact.
  //   edge-ratio: hit_pixels, hit_mse and hit_edge_l2_sq (hit_pixels.h); empty where the ratio means nothing.
  //   discrepancies: star_l2, ... and star_l2_error, ...: the root mean square of T over sets of the pattern and its
  //     standard error, by theory where that is known (no error), else over 100 sets, the same for all scenes and
  //     trials; of moving scenes star_l2_3d, in x, y and t, in place of star_l2. Empty for layout=image, whose pixels
  //     have no such sets.
  void add(const Case& c, SampleMaker& maker, const Truth& truth, CaseResult& result);

 private:
  struct OfExact {
    CoverageErrors coverage;
    Excursion excursion;
  };
  const Truth& box(std::uint32_t scene);
  const OfExact& of_exact(const Case& c, const Truth& truth);
  double flat_field(const Case& c, SampleMaker& maker);
  const std::vector<SetsDiscrepancy>& discrepancies(const Case& c, bool moves);

  const Study& study_;
  std::map<std::uint32_t, Truth> boxes_;                                            // by scene
  std::map<std::pair<std::uint32_t, std::uint32_t>, OfExact> exact_;                // by scene and filter
  std::tuple<std::uint32_t, std::uint32_t, std::uint32_t, std::uint32_t> flat_of_;  // pattern, spp, trial, layout
  std::map<std::tuple<std::uint32_t, std::uint32_t, bool>, std::vector<SetsDiscrepancy>>
      discrepancies_;                     // by pattern, spp and whether time counts
  std::map<std::uint32_t, double> flat_;  // of these, by filter
};

}  // namespace moire
