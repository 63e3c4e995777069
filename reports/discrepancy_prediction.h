// What a study of images says of discrepancies: the errors at edges over the discrepancies of the samples there, and
// how well a pattern's discrepancy predicts its errors.
#pragma once

#include <string>

#include "study/summary.h"

namespace moire {

// Markdown; "" for a study that measured neither.
std::string discrepancy_prediction(const Summary& summary);

}  // namespace moire
