// Which case a row is of.
#include "study/row_keys.h"

#include <fmt/format.h>

#include <cstdint>

namespace moire {

std::string image_row_key(const Row& row) {
  return fmt::format("{} {} {:.0f} {} {} {:.0f}{}", row.text("scene"), row.text("pattern"), row.number("spp"),
                     row.text("filter"), row.text("estimator"), row.number("trial"),
                     row.text("layout") == "image" ? " image" : "");
}

std::string set_row_key(const Row& row) {
  return fmt::format("{} {:.0f} {:.0f} {} {:.0f}", row.text("pattern"), row.number("n"), row.number("dims"),
                     row.text("measure"), row.number("trial"));
}

std::vector<std::string> row_keys(const Study& study, const std::vector<Case>& cases) {
  std::vector<std::string> keys;
  keys.reserve(cases.size());
  for (const Case& c : cases) keys.push_back(describe(study, c));
  return keys;
}

std::vector<std::string> row_keys(const DiscrepancyStudy& study, const DiscrepancyPlan& plan) {
  std::vector<std::string> keys;
  keys.reserve(plan.rows);
  for (const DiscrepancyGroup& group : plan.groups)
    for (std::uint32_t m = 0; m < study.blocks[group.block].measures.size(); ++m)
      for (std::uint32_t t = 0; t < group.trials; ++t) keys.push_back(describe(study, group, m, t));
  return keys;
}

bool is_set_row(const Row& row) { return row.find("measure") != nullptr; }

}  // namespace moire
