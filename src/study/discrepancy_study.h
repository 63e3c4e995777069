// A study without scenes: the discrepancies of patterns themselves. What its file says, checked, and its plan.
//
// Keys: name, seed, and for the sets trials, patterns, n, dims, measures; or tables [[discrepancy]] with the latter,
// for which those outside of tables are the defaults. images = "none" draws no sets.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "patterns/pattern.h"
#include "study/discrepancy_measure.h"
#include "study/document.h"

namespace moire {

// Sets that are measured alike.
struct DiscrepancyBlock {
  int trials = 100;  // sets of each pattern that varies
  std::vector<PatternChoice> patterns;
  std::vector<int> n;           // points of a set
  std::vector<int> dims = {2};  // 2: x, y; 3: x, y, t
  std::vector<DiscrepancyChoice> measures;
};

struct DiscrepancyStudy {
  std::string name, text;
  std::uint64_t seed = 1;
  bool images = true;
  std::vector<DiscrepancyBlock> blocks;
};

// Whether the file's root is of such a study: it has no scenes, and points or discrepancies instead.
bool is_discrepancy_study(const Node& root);

// Throws Error with file:line:column.
DiscrepancyStudy parse_discrepancy_study(const Node& root, std::string_view text, const std::string& stem);

// The sets of one pattern, size and kind: indices into a block's lists.
struct DiscrepancyGroup {
  std::uint32_t block = 0, pattern = 0, n = 0, dims = 0;
  std::uint32_t trials = 1;
  std::size_t first_row = 0;  // of the group in the plan; rows go measure by measure, the trials of each together
};

struct DiscrepancyPlan {
  std::vector<DiscrepancyGroup> groups;
  std::size_t rows = 0;
};

// In the order block, pattern, n, dims, measure, trial, the last one fastest. Throws Error when a pattern cannot have a
// count or a time, a discrepancy cannot take the set, two rows would have one key, or the plan is too long.
DiscrepancyPlan plan(const DiscrepancyStudy& study);

// The key of a row on one line: pattern, n, dims, measure and trial, separated by blanks.
std::string describe(const DiscrepancyStudy& study, const DiscrepancyGroup& group, std::uint32_t measure,
                     std::uint32_t trial);

}  // namespace moire
