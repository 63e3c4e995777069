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

// Largest component of a motion, in pixels: as large as images may be. Smallest one but 0: products of a time and a
// component, and their squares, stay far from the smallest normal number.
inline constexpr double kMaxMotion = 0x1p20, kMinMotion = 1e-30;

// The displacement while the shutter is open; (0, 0) where none is given.
inline Vec2 motion(const Args& args) {
  const Value* v = args.find("motion");
  if (v == nullptr) return {};
  if (v->rank != 1 || v->numbers.size() != 2) {
    throw Error(v->place, "\"motion\" must be a displacement, [dx, dy] in pixels");
  }
  for (const double d : v->numbers) {
    if (!(std::fabs(d) <= kMaxMotion) || (d != 0 && std::fabs(d) < kMinMotion)) {
      throw Error(v->place, "\"motion\" is " + shortest(d) + "; each component must be 0 or " + shortest(kMinMotion) +
                                " to " + shortest(kMaxMotion) + " pixels in magnitude");
    }
  }
  return {v->numbers[0] + 0.0, v->numbers[1] + 0.0};  // no negative zeros
}

// Its line in the table of parameters, for those who take one.
constexpr Param motion_param() {
  return numbers("motion", false, "still", "displacement while the shutter is open, [dx, dy] in pixels");
}

}  // namespace moire
