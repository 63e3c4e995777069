// The table of filters and their metrics, as texts for a terminal or a report.
#pragma once

#include <string>
#include <vector>

#include "study/results.h"

namespace moire {

// `filters` is what filter_table() (study/filter_table.h) gives. The header line, then one line per filter, rounded for
// reading: R, I, ripple, variance, H(1/2), L1, overshoot, S, P, E, edge alias energy, anisotropy.
std::vector<std::vector<std::string>> filter_cells(const Table& filters);

// What each column is, line by line: its head and a few words.
struct ColumnMeaning {
  std::string head, meaning;
};
std::vector<ColumnMeaning> filter_columns();

// The lines of filter_cells() lined up, and below them the meanings. "" for no filters.
std::string filter_text(const Table& filters);

}  // namespace moire
