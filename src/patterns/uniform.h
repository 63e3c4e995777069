// Independent uniform points, times and integers: the raw material of the random patterns.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "core/hash.h"

namespace moire {

// Points first, first + 1, ... of (key, axis); x and y, which do not overlap, get `count` numbers each, multiples of
// 2^-52 in [0, 1). The numbers of the points must not cross a multiple of 2^32.
void uniform_points(const Key& key, Axis axis, std::uint64_t first, int count, double* x, double* y) noexcept;

// The times of points 0, 1, ...: one number of (key, axis) for each, a multiple of 2^-52 in [0, 1).
void uniform_times(const Key& key, Axis axis, std::span<double> t) noexcept;

// The first two words of the numbers first, first + 1, ... of (key, axis), 64 random bits each.
void uniform_bits(const Key& key, Axis axis, std::uint32_t first, std::span<std::uint64_t> bits) noexcept;

// What makes them, for one instruction set; all give the same bits. `part` and `low` are the halves of `first`.
struct UniformKernel {
  void (*points)(const Key& key, Axis axis, std::uint32_t part, std::uint32_t low, std::size_t count, double* x,
                 double* y) noexcept;
  void (*times)(const Key& key, Axis axis, std::span<double> t) noexcept;
  void (*bits)(const Key& key, Axis axis, std::uint32_t first, std::span<std::uint64_t> bits) noexcept;
};

// Those that this machine can run, the fastest last.
std::span<const UniformKernel> uniform_kernels() noexcept;

// An integer of [0, bound), bound <= 2^29, from 64 random bits, given as words or whole: their product with bound,
// divided by 2^64. No value is more than one part in 2^35 too likely.
inline std::int32_t uniform_below(std::uint32_t high, std::uint32_t low, std::uint32_t bound) noexcept {
  const std::uint64_t carry = (std::uint64_t{low} * bound) >> 32;
  return static_cast<std::int32_t>((std::uint64_t{high} * bound + carry) >> 32);
}
inline std::int32_t uniform_below(std::uint64_t bits, std::uint32_t bound) noexcept {
  return uniform_below(static_cast<std::uint32_t>(bits >> 32), static_cast<std::uint32_t>(bits), bound);
}

}  // namespace moire
