// The rows of a run beside the plan of its study, which the header's text tells: what a run that was stopped lacks.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "study/discrepancy_study.h"
#include "study/results.h"

namespace moire {

// How many rows the study of images with this header has, and puts those that are there into its order. None, and the
// rows as they are, where the text alone does not say it (it names files) or says another study than the rows have.
std::optional<std::size_t> order_by_plan(const std::string& header, Table& rows);

// What there is of a study of discrepancies: of each set the trials up to the first that a measure lacks, as a plan of
// their own, which is what summarize() takes.
struct WholeSets {
  DiscrepancyStudy study;
  DiscrepancyPlan plan;
  Table rows;               // of that plan
  std::size_t planned = 0;  // rows of the study
};

// Puts `rows` into the study's order, too. Throws Error for a header whose text is no such study, at PATH:1, and for
// rows that are not of it, at PATH:LINE.
WholeSets whole_sets(const std::string& header, Table& rows, const std::string& path);

// Whether the header's text is a study of discrepancies; false for what cannot be read.
bool is_of_sets(const std::string& header);

}  // namespace moire
