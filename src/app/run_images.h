// A study of images: its results, pictures and report.
#pragma once

#include "app/commands.h"
#include "study/study.h"

namespace moire {

// Throws Error.
Exit run_study(const RunOptions& options, const Study& study);

}  // namespace moire
