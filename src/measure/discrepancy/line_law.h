// How random lines through the unit square are drawn.
#pragma once

#include <cstdint>

namespace moire {

enum class LineLaw : std::uint8_t {
  isotropic,  // the measure of lines that no motion of the plane changes, restricted to lines that hit the square
  printed     // the generator that D. P. Mitchell, "Ray tracing and irregularities of distribution", 1992, prints
};

}  // namespace moire
