// Four doubles at a time, by the vector extension of GCC and Clang: the same operations in the same order on every
// instruction set, in as many registers as it takes. For loops that compilers would turn into vectors of another shape.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

namespace moire {

inline constexpr std::size_t kLanes = 4;  // compilers split wider vectors into single numbers where they compare them
using Lanes [[gnu::vector_size(kLanes * sizeof(double))]] = double;
using LaneMask [[gnu::vector_size(kLanes * sizeof(double))]] = std::int64_t;  // all bits set: true

// The same for loops that are compiled for AVX-512 alone, and for those that compare and are compiled for no set.
inline constexpr std::size_t kNarrowLanes = 2;
using NarrowLanes [[gnu::vector_size(kNarrowLanes * sizeof(double))]] = double;
using NarrowLaneMask [[gnu::vector_size(kNarrowLanes * sizeof(double))]] = std::int64_t;
inline constexpr std::size_t kWideLanes = 8;
using WideLanes [[gnu::vector_size(kWideLanes * sizeof(double))]] = double;
using WideLaneMask [[gnu::vector_size(kWideLanes * sizeof(double))]] = std::int64_t;

// By reference: passed by value, vectors would have another calling convention on every instruction set.
[[gnu::always_inline]] inline void load(const double* from, Lanes& to) noexcept { std::memcpy(&to, from, sizeof to); }
[[gnu::always_inline]] inline void store(const Lanes& from, double* to) noexcept {
  std::memcpy(to, &from, sizeof from);
}
[[gnu::always_inline]] inline void load(const double* from, NarrowLanes& to) noexcept {
  std::memcpy(&to, from, sizeof to);
}
[[gnu::always_inline]] inline void load(const double* from, WideLanes& to) noexcept {
  std::memcpy(&to, from, sizeof to);
}

}  // namespace moire
