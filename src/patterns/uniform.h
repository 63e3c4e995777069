// Independent uniform points: the raw material of the random patterns.
#pragma once

#include <cstdint>

#include "core/hash.h"

namespace moire {

// Points first, first + 1, ... of (key, axis); x and y get `count` numbers each, multiples of 2^-52 in [0, 1). The
// numbers of the points must not cross a multiple of 2^32.
inline void uniform_points(const Key& key, Axis axis, std::uint64_t first, int count, double* __restrict x,
                           double* __restrict y) noexcept {
  const auto part = static_cast<std::uint32_t>(first >> 32), low = static_cast<std::uint32_t>(first);
  for (int i = 0; i < count; ++i) {
    const Words w = hash(key, low + static_cast<std::uint32_t>(i), axis, part);
    x[i] = unit(w.a, w.b);
    y[i] = unit(w.c, w.d);
  }
}

}  // namespace moire
