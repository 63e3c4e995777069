// Tables as CSV: RFC 4180 (Shafranovich, 2005), but with LF line ends.
#pragma once

#include <string>

#include "study/results.h"

namespace moire {

// A header line with the union of all columns, in the order in which they are first seen, then one line per row.
// Numbers have a decimal point whatever the locale, doubles are the shortest that read back as the same bits; missing
// values, NaN and infinities are empty fields, an empty text is "". An empty table is an empty text.
std::string csv(const Table& table);

}  // namespace moire
