// Filters and their metrics as rows, for the sinks: `moire filters`, and the table beside a study's results.
#pragma once

#include <span>

#include "filters/filter.h"
#include "study/results.h"

namespace moire {

// One row per filter, in their order: filter (as it was written), radius, pieces and degree (of the polynomials between
// knots; a fit's, where the kernel is none), kernel_error (bound on |k|'s error, per pixel), then the fields of
// FilterMetrics (measure/filter_metrics.h; for radial filters measure/radial_metrics.h) by their names, all finite.
Table filter_table(std::span<const Filter> filters);

}  // namespace moire
