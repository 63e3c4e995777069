// Which case a row is of: its key in words, as a plan names it.
#pragma once

#include <string>

#include "study/results.h"

namespace moire {

// The key of a row of a study of images, and of one of discrepancies: as describe() writes that of its case.
std::string image_row_key(const Row& row);
std::string set_row_key(const Row& row);

// Whether the row is of a study of discrepancies alone.
bool is_set_row(const Row& row);

}  // namespace moire
