// On which side of a line or a circle many points are, or in squares of which colour of a board in perspective, in
// floating point, and whether any is too near to say.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>

#include "core/geometry.h"
#include "core/rounding.h"

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

// A board in perspective (homography.h): U, V and W at a point are a x + b y + c, right to `error`; u = U / W, v = V /
// W. A point is clearly before the camera where W is above 4 errors, and clearly behind it where W is below -error.
struct BoardSign {
  struct Row {
    double a, b, c, error;
  } u, v, w;
  double u0, u1, v0, v1;  // sides of the board
};

// Bound on the error of q = U / W, by division or by the reciprocal r of W, where U may be off by eu and W, at least
// 4 ew, by ew: half as much again for the second order, and the rounding of quotient and reciprocal.
[[gnu::always_inline]] inline double quotient_error(double q, double eu, double ew, double r) noexcept {
  return (eu + std::fabs(q) * ew) * (1.5 * r) + 4 * kUnit * std::fabs(q);
}

// What mark_squares() writes for doubtful points.
inline constexpr std::uint8_t kDoubtful = 2;

// The loops for one instruction set; all give the same bits. Each returns whether a point is doubtful.
struct SignLoops {
  // inside[i] = 1 where the value is not negative, otherwise 0.
  bool (*mark_above)(const LineSign& line, std::span<const double> x, std::span<const double> y,
                     std::uint8_t* inside) noexcept;
  // inside[i] = 1 where the value is below -doubt; the others stay as they are.
  bool (*mark_within)(const CircleSign& circle, std::span<const double> x, std::span<const double> y,
                      std::uint8_t* inside) noexcept;
  // inside[i] = 1 where the point is clearly before the camera, on the board and within a square (floor u + floor v)
  // even, 0 where it is clearly within an odd one or behind the camera, otherwise kDoubtful.
  bool (*mark_squares)(const BoardSign& board, std::span<const double> x, std::span<const double> y,
                       std::uint8_t* inside) noexcept;
};

// Those that this machine can run, the fastest last.
std::span<const SignLoops> sign_loops() noexcept;

}  // namespace moire
