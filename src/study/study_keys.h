// Keys that every kind of study has.
#pragma once

#include <cstdint>

#include "study/document.h"
#include "study/study.h"

namespace moire {

// Throw Error with file:line:column.
std::uint64_t seed_of(const Node& node);
Images images_of(const Node& node);

}  // namespace moire
