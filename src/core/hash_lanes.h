// hash() of many indices at once, by the vector extension of GCC and Clang: as many as a register of the instruction
// set has words. The words are those of hash(); compilers, left to themselves, spend as long on turning words into
// numbers as on the hash.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <utility>

#include "core/hash.h"

namespace moire {

// Vectors of so many bytes. Spelt out: GCC 12 takes a vector of a size that depends on a template's parameter for a
// single number while it reads the template.
template <std::size_t bytes>
struct VectorsOf;
#define MOIRE_VECTORS_OF(bytes)                             \
  template <>                                               \
  struct VectorsOf<bytes> {                                 \
    using Word [[gnu::vector_size(bytes)]] = std::uint32_t; \
    using Bits [[gnu::vector_size(bytes)]] = std::uint64_t; \
    using Real [[gnu::vector_size(bytes)]] = double;        \
  };
MOIRE_VECTORS_OF(16)
MOIRE_VECTORS_OF(32)
MOIRE_VECTORS_OF(64)
#undef MOIRE_VECTORS_OF

// `width` indices, 4, 8 or 16: words in one register, numbers of 64 bits in two.
template <std::size_t width>
struct HashLanes {
  static constexpr std::size_t kWidth = width, kHalf = width / 2;
  using Word = typename VectorsOf<4 * width>::Word;
  using Bits = typename VectorsOf<4 * width>::Bits;
  using Real = typename VectorsOf<4 * width>::Real;

  // 64 random bits of each index for each of two coordinates, (a, b) and (c, d) of Words, high word first: of the first
  // half of the indices, then of the second.
  struct Pair {
    Bits x[2], y[2];
  };

  // 0, 1, 2, ...
  [[gnu::always_inline]] static void count_up(Word& to) noexcept {
    std::array<std::uint32_t, width> numbers{};
    for (std::size_t i = 0; i < width; ++i) numbers[i] = static_cast<std::uint32_t>(i);
    std::memcpy(&to, numbers.data(), sizeof to);
  }

  // The numbers begin, begin + 1, ... as numbers of 64 bits.
  [[gnu::always_inline]] static void count_up_from(std::size_t begin, Bits& to) noexcept {
    std::array<std::uint64_t, kHalf> numbers{};
    for (std::size_t i = 0; i < kHalf; ++i) numbers[i] = i;
    std::memcpy(&to, numbers.data(), sizeof to);
    to += begin;
  }

  // By reference throughout: passed by value, vectors would have another calling convention on every instruction set.
  [[gnu::always_inline]] static void hash(const Key& key, const Word& index, Axis axis, std::uint32_t part,
                                          Pair& out) noexcept {
    Word a, b = Word{} + static_cast<std::uint32_t>(axis), c = Word{} + part, d = Word{};
    spread(index, a);
    threefry4x32<12>(key, a, b, c, d);
    join(a, b, out.x);
    join(c, d, out.y);
  }

 private:
  // Words are joined within blocks of 128 bits, which is one instruction: of each block of four indices the first two
  // make numbers of the first half, the others of the second. So indices are dealt out that way.
  [[gnu::always_inline]] static void spread(const Word& from, Word& to) noexcept {
    [&]<std::size_t... i>(std::index_sequence<i...>) __attribute__((always_inline)) {
      to = __builtin_shufflevector(from, from, (i / 4 * 2 + i % 2 + (i % 4 < 2 ? 0 : kHalf))...);
    }
    (std::make_index_sequence<width>());
  }
  [[gnu::always_inline]] static void join(const Word& high, const Word& low, Bits (&to)[2]) noexcept {
    constexpr bool kLowFirst = std::endian::native == std::endian::little;
    const Word &first = kLowFirst ? low : high, &second = kLowFirst ? high : low;
    [&]<std::size_t... i>(std::index_sequence<i...>) __attribute__((always_inline)) {
      to[0] =
          reinterpret_cast<Bits>(__builtin_shufflevector(first, second, (i / 4 * 4 + i % 4 / 2 + i % 2 * width)...));
      to[1] = reinterpret_cast<Bits>(
          __builtin_shufflevector(first, second, (i / 4 * 4 + i % 4 / 2 + 2 + i % 2 * width)...));
    }
    (std::make_index_sequence<width>());
  }
};

// Numbers 0 .. count - 1 of what `block` makes from hashes: block.operator()<Lanes>(pair, i, x, y) writes Lanes::kWidth
// numbers to each of x and y, those of i, i + 1, ...; index.operator()<Lanes>(i, to) gives the indices to be hashed.
// Some blocks are narrower than `width`. Whoever makes one number alone gives the same pointer twice and writes x.
template <std::size_t width, class Index, class Block, class T>
[[gnu::always_inline]] inline void fill_from_hashes(const Key& key, Axis axis, std::uint32_t part, std::size_t count,
                                                    const Index& index, const Block& block, T* x, T* y) noexcept {
  std::size_t i = 0;
  const auto make = [&]<class Lanes>(Lanes, T * to_x, T * to_y) __attribute__((always_inline)) {
    typename Lanes::Word numbers;
    typename Lanes::Pair pair;
    index.template operator()<Lanes>(i, numbers);
    Lanes::hash(key, numbers, axis, part, pair);
    block.template operator()<Lanes>(pair, i, to_x, to_y);
  };
  using Wide = HashLanes<width>;
  for (; i + Wide::kWidth <= count; i += Wide::kWidth) make(Wide{}, x + i, y + i);
  using Narrow = HashLanes<4>;
  if constexpr (width > Narrow::kWidth) {
    for (; i + Narrow::kWidth <= count; i += Narrow::kWidth) make(Narrow{}, x + i, y + i);
  }
  if (i == count) return;
  std::array<T, Narrow::kWidth> last_x, last_y;
  make(Narrow{}, last_x.data(), last_y.data());
  std::memcpy(x + i, last_x.data(), (count - i) * sizeof(T));
  if (y != x) std::memcpy(y + i, last_y.data(), (count - i) * sizeof(T));
}

// The index of fill_from_hashes() for the numbers first, first + 1, ...
struct ConsecutiveIndices {
  std::uint32_t first;
  template <class Lanes>
  [[gnu::always_inline]] void operator()(std::size_t i, typename Lanes::Word& to) const noexcept {
    Lanes::count_up(to);
    to += first + static_cast<std::uint32_t>(i);
  }
};

}  // namespace moire
