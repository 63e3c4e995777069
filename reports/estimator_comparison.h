// Estimators side by side: what the same number of samples gives.
#pragma once

#include <string>

#include "study/summary.h"

namespace moire {

// Markdown: one table per scene and pattern, filters and sample counts down, estimators across. "" for a study of one
// estimator.
std::string estimator_comparison(const Summary& summary);

}  // namespace moire
