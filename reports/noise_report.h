// What the errors look like: patterns ranked by the size of their errors, by their grain, by their structure and by
// what the eye sees of them, side by side.
#pragma once

#include <string>

#include "study/summary.h"

namespace moire {

// Markdown: the rankings over the scenes, by filter and sample count, then the numbers of each scene at the largest
// count. "" for a study that did not measure `spectrum`.
std::string noise_report(const Summary& summary);

// The rankings at each sample count, for a terminal.
std::string noise_text(const Summary& summary, bool bold);

}  // namespace moire
