// Filters side by side: what the samples miss, what the filter itself changes, and what both leave against coverage.
#pragma once

#include <string>

#include "study/summary.h"

namespace moire {

// Markdown: the ranking over scenes, then one table per scene, at the largest sample count. "" for a study that did not
// measure coverage or has but one filter.
std::string filter_comparison(const Summary& summary);

}  // namespace moire
