// The report that a person reads, as Markdown (GitHub's tables): the answer first, then a section per pattern.
#pragma once

#include <string>
#include <string_view>

#include "study/summary.h"

namespace moire {

// `rows` are the raw rows in plan order, `summary` what summarize() made of them, `filters` what filter_table() says of
// the study's filters, if it measured them. Image paths are taken from the cells
// image_error_png and image_got_png and are relative to the report. Times are left out: the same rows and summary,
// time_* apart, give the same bytes.
std::string markdown_report(std::string_view study_name, const Table& rows, const Summary& summary,
                            const Table& filters = {});

}  // namespace moire
