// The report of a study of discrepancies: values beside theory and Mitchell's tables, rates of convergence, pictures.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "study/discrepancy_summary.h"

namespace moire {

// What a picture shows, and its file, relative to the report's folder.
using Picture = std::pair<std::string, std::string>;

// report.md.
std::string discrepancy_markdown(std::string_view study_name, const DiscrepancySummary& summary,
                                 const std::vector<Picture>& pictures);

// Tables for a terminal, one per measure and number of dimensions; `bold` marks the best by ANSI, too.
std::string discrepancy_text(const DiscrepancySummary& summary, bool bold);

}  // namespace moire
