// Independent uniform points, times and integers: the raw material of the random patterns.
#pragma once

#include <cstdint>
#include <span>

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

// The times of points 0, 1, ...: one number of (key, axis) for each, a multiple of 2^-52 in [0, 1).
inline void uniform_times(const Key& key, Axis axis, std::span<double> t) noexcept {
  std::uint32_t i = 0;
  for (double& time : t) {
    const Words w = hash(key, i++, axis);
    time = unit(w.a, w.b);
  }
}

// An integer of [0, bound), bound <= 2^29, from the 64 random bits (high, low): their product with bound, divided by
// 2^64. No value is more than one part in 2^35 too likely.
inline std::int32_t uniform_below(std::uint32_t high, std::uint32_t low, std::uint32_t bound) noexcept {
  const std::uint64_t carry = (std::uint64_t{low} * bound) >> 32;
  return static_cast<std::int32_t>((std::uint64_t{high} * bound + carry) >> 32);
}

}  // namespace moire
