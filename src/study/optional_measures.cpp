// The measures that a study names beyond `error`.
#include "study/optional_measures.h"

#include <string>

#include "study/columns.h"
#include "study/flat_field.h"
#include "study/hit_pixels.h"

namespace moire {
namespace {

Excursion excursion_of(const ActiveRows& rows, const Rendered& image) {
  ExcursionTally tally;
  for_each_rendered(rows, image, [&](int, int, Cover, double value) { tally.add(value); });
  tally.add_flat(std::int64_t{rows.grid().width} * rows.grid().height - static_cast<std::int64_t>(image.value.size()));
  return tally.finish();
}

void set_coverage(Row& row, const std::string& what, const CoverageErrors& errors) {
  set_main_errors(row, what + "_active", errors.active);
  set_main_errors(row, what + "_all", errors.all);
}

void set_excursion(Row& row, const std::string& what, const Excursion& e) {
  row.set("overshoot_" + what, e.overshoot);
  row.set("undershoot_" + what, e.undershoot);
  row.set("ringing_rms_" + what, e.rms);
}

}  // namespace

const Truth& OptionalMeasures::box(std::uint32_t scene) {
  const auto known = boxes_.find(scene);
  if (known != boxes_.end()) return known->second;
  const Filter unit_box(parse_spec("box", "coverage"));
  return boxes_.emplace(scene, find_truth(study_.scenes[scene].image, unit_box, study_.accuracy)).first->second;
}

const OptionalMeasures::OfExact& OptionalMeasures::of_exact(const Case& c, const Truth& truth) {
  const auto [known, is_new] = exact_.try_emplace({c.scene, c.filter});
  if (is_new) {
    Rendered image;
    image.value = truth.exact.value;
    if (study_.measures.has(Measure::coverage)) {
      known->second.coverage = coverage_errors(truth.rows, image, box(c.scene));
    }
    if (study_.measures.has(Measure::ringing)) known->second.excursion = excursion_of(truth.rows, image);
  }
  return known->second;
}

double OptionalMeasures::flat_field(const Case& c, SampleMaker& maker) {
  const std::tuple key(c.pattern, c.spp, c.trial, c.layout);
  if (key != flat_of_) flat_.clear();
  flat_of_ = key;
  const auto [known, is_new] = flat_.try_emplace(c.filter, 0.0);
  if (is_new) known->second = flat_field_rms(maker.samples(c, kFlatField), study_.filters[c.filter]);
  return known->second;
}

const std::vector<SetsDiscrepancy>& OptionalMeasures::discrepancies(const Case& c, bool moves) {
  const auto [known, is_new] = discrepancies_.try_emplace({c.pattern, c.spp, moves});
  if (is_new) {
    known->second =
        discrepancies_of(study_.patterns[c.pattern], study_.spp[c.spp], moves, study_.seed, study_.discrepancies);
  }
  return known->second;
}

void OptionalMeasures::add(const Case& c, SampleMaker& maker, const Truth& truth, CaseResult& result) {
  Row& row = result.row;
  if (study_.measures.has(Measure::coverage)) {
    set_coverage(row, "coverage", coverage_errors(truth.rows, result.got, box(c.scene)));
    set_coverage(row, "filter", of_exact(c, truth).coverage);
  }
  if (study_.measures.has(Measure::flat_field)) row.set("flat_field_rms", flat_field(c, maker));
  if (study_.measures.has(Measure::edge_ratio)) {
    const bool same = study_.layouts[c.layout] == Layout::pixel && !varies(study_, c.scene, c.pattern);
    set_hit_pixels(row, has_edge_ratio(study_, c) ? hit_pixels(truth, result, maker.samples(c), same) : HitPixels{});
  }
  if (!study_.discrepancies.empty()) {
    const bool moves = study_.scenes[c.scene].image.moves(), has_sets = study_.layouts[c.layout] == Layout::pixel;
    const std::vector<SetsDiscrepancy> none(study_.discrepancies.size());
    const std::vector<SetsDiscrepancy>& values = has_sets ? discrepancies(c, moves) : none;
    for (std::size_t i = 0; i < values.size(); ++i) {
      const DiscrepancyInfo& info = study_.discrepancies[i].info();
      const std::string column = discrepancy_column(info, moves && info.has_3d);
      row.set(column, has_sets ? finite_cell(values[i].rms) : Cell());
      row.set(column + "_error", has_sets ? finite_cell(values[i].error) : Cell());
    }
  }
  if (study_.measures.has(Measure::ringing)) {
    set_excursion(row, "got", excursion_of(truth.rows, result.got));
    set_excursion(row, "exact", of_exact(c, truth).excursion);
  }
}

}  // namespace moire
