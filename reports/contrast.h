// Families of random edges side by side: which patterns depend on the direction of an edge.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "study/summary.h"

namespace moire {

// The scenes of a summary that are families of random lines and have slopes.
std::vector<std::string> line_families(const Summary& summary);

// One paragraph per filter and estimator: at which rates the error of each pattern falls on the families, first the
// patterns for which the 95% intervals of two of them are apart. `mark` goes around names. "" for fewer than two
// families.
std::string slope_contrast(const Summary& summary, std::string_view mark);

}  // namespace moire
