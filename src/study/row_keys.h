// Which case a row is of: its key in words, as a plan names it.
#pragma once

#include <string>
#include <vector>

#include "study/discrepancy_study.h"
#include "study/results.h"
#include "study/study.h"

namespace moire {

// The key of a row of a study of images, and of one of discrepancies: as describe() writes that of its case.
std::string image_row_key(const Row& row);
std::string set_row_key(const Row& row);

// The keys of all rows of a plan, in its order.
std::vector<std::string> row_keys(const Study& study, const std::vector<Case>& cases);
std::vector<std::string> row_keys(const DiscrepancyStudy& study, const DiscrepancyPlan& plan);

// Whether the row is of a study of discrepancies alone.
bool is_set_row(const Row& row);

}  // namespace moire
