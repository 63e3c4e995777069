// Studies of discrepancies: from a file to a plan.
#include "study/discrepancy_study.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>
#include <tuple>

#include "core/error.h"
#include "core/names.h"
#include "study/lists.h"
#include "study/study.h"
#include "study/study_keys.h"

namespace moire {
namespace {

constexpr auto kBlockKeys = std::to_array<std::string_view>({"trials", "patterns", "n", "dims", "measures"});
constexpr auto kOuterKeys = std::to_array<std::string_view>({"name", "seed", "images", "discrepancy"});

// Sets what the table gives.
void read_block(const Node& table, DiscrepancyBlock& block) {
  if (const Node* n = table.find("trials")) block.trials = static_cast<int>(integer_of(*n, "trials", 1, kMaxTrials));
  if (const Node* n = table.find("patterns")) {
    block.patterns = specs_of<PatternChoice>(*n, "patterns", "[\"jittered\"]", [](const auto& text, const auto& place) {
      return PatternChoice(parse_spec(text, place));
    });
  }
  if (const Node* n = table.find("n")) {
    block.n = integers_of(*n, "n", "[16, 256, 1600]", "a number of points", 1, kMaxSamples);
  }
  if (const Node* n = table.find("dims"))
    block.dims = integers_of(*n, "dims", "[2, 3]", "a number of dimensions", 2, 3);
  if (const Node* n = table.find("measures")) {
    block.measures = specs_of<DiscrepancyChoice>(
        *n, "measures", "[\"star-l2\"]",
        [](const auto& text, const auto& place) { return DiscrepancyChoice(parse_spec(text, place)); });
  }
}

void require_whole(const Node& where, const DiscrepancyBlock& block) {
  const auto refuse = [&](const char* what, const char* example) {
    throw Error(where.place, fmt::format("the discrepancies have no {}; add {}", what, example));
  };
  if (block.patterns.empty()) refuse("patterns", "patterns = [\"jittered\"]");
  if (block.n.empty()) refuse("n", "n = [16, 256]");
  if (block.measures.empty()) refuse("measures", "measures = [\"star-l2\"]");
}

// Throws for a key of the table that is not among the known ones.
void check_keys(const Node& table, std::string_view what, const std::vector<std::string_view>& known) {
  for (const Node& node : table.items) {
    if (std::find(known.begin(), known.end(), node.key) == known.end()) {
      throw Error(node.key_place, fmt::format("{}: {}", what, unknown_name("key", node.key, known)));
    }
  }
}

}  // namespace

bool is_discrepancy_study(const Node& root) {
  if (root.find("scene") != nullptr) return false;
  if (root.find("n") != nullptr || root.find("discrepancy") != nullptr) return true;
  const Node* measures = root.find("measures");
  return measures != nullptr && measures->kind == Node::Kind::list &&
         std::any_of(measures->items.begin(), measures->items.end(), [](const Node& item) {
           return item.kind == Node::Kind::text && is_discrepancy(item.text.substr(0, item.text.find(':')));
         });
}

DiscrepancyStudy parse_discrepancy_study(const Node& root, std::string_view text, const std::string& stem) {
  std::vector<std::string_view> known(kOuterKeys.begin(), kOuterKeys.end());
  const std::vector<std::string_view> of_block(kBlockKeys.begin(), kBlockKeys.end());
  known.insert(known.end(), of_block.begin(), of_block.end());
  check_keys(root, "study without scenes", known);
  DiscrepancyStudy study;
  study.text = std::string(text);
  study.name = stem;
  if (const Node* n = root.find("name")) study.name = name_of(*n, "name");
  if (const Node* n = root.find("seed")) study.seed = seed_of(*n);
  if (const Node* n = root.find("images")) study.images = images_of(*n) != Images::none;
  DiscrepancyBlock common;
  read_block(root, common);
  const Node* tables = root.find("discrepancy");
  if (tables == nullptr) {
    require_whole(root, common);
    study.blocks.push_back(std::move(common));
    return study;
  }
  for (const Node& table : list_of(*tables, "discrepancy", "[[discrepancy]]")) {
    if (table.kind != Node::Kind::table) {
      throw Error(table.place,
                  fmt::format("discrepancy is {}; write it as a table [[discrepancy]]", kind_name(table.kind)));
    }
    check_keys(table, "discrepancy", of_block);
    DiscrepancyBlock block = common;
    read_block(table, block);
    require_whole(table, block);
    study.blocks.push_back(std::move(block));
  }
  return study;
}

DiscrepancyPlan plan(const DiscrepancyStudy& study) {
  DiscrepancyPlan plan;
  std::set<std::tuple<std::string, int, int, std::string>> seen;
  for (std::uint32_t b = 0; b < study.blocks.size(); ++b) {
    const DiscrepancyBlock& block = study.blocks[b];
    for (std::uint32_t p = 0; p < block.patterns.size(); ++p) {
      const PatternChoice& pattern = block.patterns[p];
      for (std::uint32_t n = 0; n < block.n.size(); ++n) {
        pattern.require_count(block.n[n]);
        for (std::uint32_t d = 0; d < block.dims.size(); ++d) {
          if (block.dims[d] == 3) pattern.require_time();
          for (const DiscrepancyChoice& measure : block.measures) {
            measure.require(block.n[n], block.dims[d]);
            if (!seen.emplace(pattern.text(), block.n[n], block.dims[d], measure.text()).second) {
              throw Error("study", fmt::format("{} of {} points of \"{}\" in {} dimensions is asked for twice; once "
                                               "will do",
                                               measure.text(), block.n[n], pattern.text(), block.dims[d]));
            }
          }
          const auto trials = static_cast<std::uint32_t>(pattern.varies(block.dims[d] == 3) ? block.trials : 1);
          plan.groups.push_back({b, p, n, d, trials, plan.rows});
          plan.rows += std::size_t{trials} * block.measures.size();
          if (plan.rows > kMaxRows) {
            throw Error("study", fmt::format("the plan has more than {} rows; name fewer patterns, n, measures or "
                                             "trials",
                                             kMaxRows));
          }
        }
      }
    }
  }
  return plan;
}

std::string describe(const DiscrepancyStudy& study, const DiscrepancyGroup& group, std::uint32_t measure,
                     std::uint32_t trial) {
  const DiscrepancyBlock& block = study.blocks[group.block];
  return fmt::format("{} {} {} {} {}", block.patterns[group.pattern].text(), block.n[group.n], block.dims[group.dims],
                     block.measures[measure].text(), trial);
}

}  // namespace moire
