// On which side of a line or a circle many points are, in floating point, and whether any is too near to say.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "core/geometry.h"

namespace moire {

// Values at a point: x normal.x + y normal.y - offset, and x (x - twice_center.x) + y (y - twice_center.y) - power. A
// point is doubtful where the magnitude is `doubt` or less.
struct LineSign {
  Vec2 normal;
  double offset, doubt;
};
struct CircleSign {
  Vec2 twice_center;
  double power, doubt;
};

// The loops for one instruction set; all give the same bits. Each returns whether a point is doubtful.
struct SignLoops {
  // inside[i] = 1 where the value is not negative, otherwise 0.
  bool (*mark_above)(const LineSign& line, std::span<const double> x, std::span<const double> y,
                     std::uint8_t* inside) noexcept;
  // inside[i] = 1 where the value is below -doubt; the others stay as they are.
  bool (*mark_within)(const CircleSign& circle, std::span<const double> x, std::span<const double> y,
                      std::uint8_t* inside) noexcept;
};

// Those that this machine can run, the fastest last.
std::span<const SignLoops> sign_loops() noexcept;

}  // namespace moire
