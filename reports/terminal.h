// The answer on a terminal: per scene and filter, patterns by samples per pixel.
#pragma once

#include <string>

#include "study/summary.h"

namespace moire {

// First, for families of random edges, how their rates compare (contrast.h), and the ranking of filters where coverage
// was measured, and those of noise (noise_report.h). Then one table per scene, filter and estimator: RMSE over active
// pixels by pattern and spp, and the fitted slope with half its 95% interval; with many filters one per scene and
// pattern, filters under each other. The smallest of each column has a `*` after it (each of several equal ones), and
// is bold with `bold` (ANSI, for terminals only).
// "~" follows values that the reference's own bound may show in; "-" is no value.
std::string terminal_tables(const Summary& summary, bool bold);

}  // namespace moire
