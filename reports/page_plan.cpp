// The rows of a run beside the plan of its study.
#include "reports/page_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <unordered_map>
#include <utility>
#include <vector>

#include "core/error.h"
#include "reports/json.h"
#include "reports/page_rows.h"
#include "study/document.h"
#include "study/row_keys.h"
#include "study/study.h"

namespace moire {
namespace {

std::string text_in(const std::string& header) { return text_at(header, "/study/text"); }

// Where each row stands in the plan; `keys.size()` for one that does not.
std::vector<std::size_t> places_in(const std::vector<std::string>& keys, const Table& rows,
                                   std::string (*key_of)(const Row&)) {
  std::unordered_map<std::string, std::size_t> index_of;
  for (std::size_t i = 0; i < keys.size(); ++i) index_of.emplace(keys[i], i);
  std::vector<std::size_t> places;
  for (const Row& row : rows) {
    const auto at = index_of.find(key_of(row));
    places.push_back(at == index_of.end() ? keys.size() : at->second);
  }
  return places;
}

// One row per key, without cells where there is none. Takes the rows, whose keys differ.
Table placed(Table rows, const std::vector<std::size_t>& places, std::size_t count) {
  Table all(count);
  for (std::size_t i = 0; i < rows.size(); ++i) all[places[i]] = std::move(rows[i]);
  return all;
}

Table without_gaps(Table rows) {
  std::erase_if(rows, [](const Row& row) { return row.cells().empty(); });
  return rows;
}

// Trials of the group before the first that lacks a row of any measure.
std::uint32_t whole_trials(const DiscrepancyGroup& group, std::size_t measures, const Table& all) {
  for (std::uint32_t t = 0; t < group.trials; ++t)
    for (std::size_t m = 0; m < measures; ++m)
      if (all[group.first_row + m * group.trials + t].cells().empty()) return t;
  return group.trials;
}

}  // namespace

std::optional<std::size_t> order_by_plan(const std::string& header, Table& rows) {
  try {
    const std::string text = text_in(header);
    const Study study = parse_study(text, "study", text_at(header, "/study/name"));
    if (study.text != text) return std::nullopt;  // texts of files are appended, and would be so again
    const std::vector<std::string> keys = row_keys(study, plan(study));
    const std::vector<std::size_t> places = places_in(keys, rows, image_row_key);
    if (std::find(places.begin(), places.end(), keys.size()) != places.end()) return std::nullopt;
    rows = without_gaps(placed(std::move(rows), places, keys.size()));
    return keys.size();
  } catch (const Error&) {
    return std::nullopt;  // of another version of the program, or of files that are not found from here
  }
}

WholeSets whole_sets(const std::string& header, Table& rows, const std::string& path) {
  const std::string text = text_in(header);
  WholeSets whole;
  whole.study = parse_discrepancy_study(parse_toml(text, path + ":1"), text, text_at(header, "/study/name"));
  const DiscrepancyPlan planned = plan(whole.study);
  const std::vector<std::string> keys = row_keys(whole.study, planned);
  const std::vector<std::size_t> places = places_in(keys, rows, set_row_key);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (places[i] < keys.size()) continue;
    throw Error(fmt::format("{}:{}", path, i + 2),
                fmt::format("\"{}\" is no case of this study; mend or remove the line", set_row_key(rows[i])));
  }
  whole.planned = planned.rows;
  Table all = placed(std::move(rows), places, keys.size());
  for (DiscrepancyGroup group : planned.groups) {
    const std::size_t measures = whole.study.blocks[group.block].measures.size(), first = group.first_row;
    const std::uint32_t of_plan = group.trials;
    group.trials = whole_trials(group, measures, all);
    group.first_row = whole.rows.size();
    if (group.trials == 0) continue;
    for (std::size_t m = 0; m < measures; ++m)
      for (std::uint32_t t = 0; t < group.trials; ++t) whole.rows.push_back(all[first + m * of_plan + t]);
    whole.plan.groups.push_back(group);
  }
  whole.plan.rows = whole.rows.size();
  rows = without_gaps(std::move(all));
  return whole;
}

bool is_of_sets(const std::string& header) {
  try {
    return is_discrepancy_study(parse_toml(text_in(header), "study"));
  } catch (const Error&) {
    return false;
  }
}

}  // namespace moire
