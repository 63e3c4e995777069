// A study of discrepancies: its results, pictures and report.
#pragma once

#include "app/commands.h"
#include "study/discrepancy_study.h"

namespace moire {

// Throws Error.
Exit run_study(const RunOptions& options, const DiscrepancyStudy& study);

}  // namespace moire
