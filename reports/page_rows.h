// What a page asks of the rows of a results file, whoever wrote it: names, counts and numbers where it reads them.
#pragma once

#include <string>

#include "study/results.h"

namespace moire {

// Row i stands in line i + 2 of the file. Throws Error at PATH:LINE for a row without its key or with a key that stands
// above already, for a count that is none, for text among a column's numbers, and as check_names() does.
void check_rows(const Table& rows, const std::string& path);

// Links to a page join names with '|'. Throws Error at PATH:LINE for a name that holds it.
void check_names(const Table& rows, const std::string& path);

}  // namespace moire
