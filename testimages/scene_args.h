// Reading the parameters that scenes share: points, lengths, and their limits.
#pragma once

#include <cmath>
#include <string>

#include "core/args.h"
#include "core/error.h"
#include "core/geometry.h"

namespace moire {

// Largest coordinate and radius of a scene, in pixels: squares and products stay far from overflow.
inline constexpr double kMaxCoordinate = 1e15;

inline void require_within(const Value& v, std::string_view name, double x) {
  if (std::fabs(x) > kMaxCoordinate) {
    throw Error(v.place, "\"" + std::string(name) + "\" is " + shortest(x) + "; at most " + shortest(kMaxCoordinate) +
                             " pixels in magnitude");
  }
}

// A point [x, y]; the parameter must be there.
inline Vec2 point(const Args& args, std::string_view name) {
  const Value& v = *args.find(name);
  if (v.rank != 1 || v.numbers.size() != 2) {
    throw Error(v.place, "\"" + std::string(name) + "\" must be a point, [x, y] in pixels");
  }
  for (const double x : v.numbers) require_within(v, name, x);
  return {v.numbers[0], v.numbers[1]};
}

}  // namespace moire
