// Random numbers without state: every number is a hash of (seed, trial, pixel, index, axis), so that results depend on
// no order, no run and no thread. Threefry4x32 with 12 rounds, after Salmon, Moraes, Dror and Shaw, "Parallel random
// numbers: as easy as 1, 2, 3", SC 2011; it uses additions, rotations and exclusive ors of 32-bit words only.
//
// Two stages. Per pixel, 64-bit arithmetic folds (seed, trial, pixel) into a Key. Per sample, hash() turns
// (key, index, axis) into four words, enough for two coordinates of 52 bits; loops over index vectorise.
//
// The choice (g++ 12 -O3, ns for both coordinates of a sample, with AVX2 / with SSE2; avalanche: worst |z| over all
// pairs of input bit and used output bit, 2^15 flips each, where about 4 is expected of a perfect hash):
//   pcg4d (Jarzynski and Olano, JCGT 2020)         1.7 / 4.2   |z| 181: high input bits never reach low output bits
//   pcg4d, a third round                           2.6 / 6.4   |z| 20
//   pcg4d, a third round and a last shift          3.2 / 6.9   |z| 4.1
//   threefry4x32-12 (this one)                     2.6 / 5.0   |z| 4.2
//   philox4x32-7, 64-bit products                  6.0 / 6.7   |z| 4.4
//   lowbias32 mixers in a chain of six             3.6 / 8.0   |z| 4.0
// Among those without a flaw Threefry is the fastest; its authors report that 12 rounds pass the whole of BigCrush. For
// one key it is a bijection of its counter: no two (index, axis) of a pixel share all four words.
#pragma once

#include <array>
#include <bit>
#include <cstdint>

#include "core/geometry.h"

namespace moire {

// What a number is for. Numbers of different axes are independent; each axis gives two coordinates per index.
enum class Axis : std::uint32_t {
  xy,          // the position of sample `index`
  order,       // permutations
  shift,       // one toroidal shift per pixel
  scramble,    // one digit scramble per pixel
  pick,        // which one of a bank of sets
  dart,        // candidates of dart-throwing inside a pixel
  bank,        // candidates of set s of a bank; the pixel is (s, 0)
  set,         // candidates of the one set that belongs to no pixel
  area,        // a set over a whole image: positions, candidates, its shift; the pixel is (0, 0)
  area_order,  // permutations of such a set
  line,        // random lines of a study's scenes; the pixel is (0, 0)
  field,       // the disks of a noise field: radii in part 0, candidates of centres from part 1 on; the pixel is (0, 0)
  time,        // the time of sample `index`
  scan,        // candidates of that time: the part counts them
  area_time,   // the times of a set over a whole image; the pixel is (0, 0)
  test_line,   // lines that test a set of points
  test_box,    // boxes that do
  test_disk,   // disks that do
};

// 128 bits that stand for (seed, trial, pixel). Two pixels of one draw with different coordinates modulo 2^32 never
// share a key; otherwise two keys are equal with probability 2^-64 or less.
struct Key {
  std::array<std::uint32_t, 4> words{};
};

// Two 64-bit numbers as words, high word first: (a, b) and (c, d).
struct Words {
  std::uint32_t a, b, c, d;
};

// A bijection of 64-bit words with full avalanche: variant 13 of David Stafford, "Better bit mixing" (2011), the
// finaliser of SplitMix64 (Steele, Lea and Flood, OOPSLA 2014).
constexpr std::uint64_t mix64(std::uint64_t z) noexcept {
  z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
  z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
  return z ^ (z >> 31);
}

// The part of the key that all pixels of a draw share.
constexpr std::uint64_t draw_hash(std::uint64_t seed, std::uint32_t trial) noexcept {
  constexpr std::uint64_t kGolden = 0x9E3779B97F4A7C15u;  // 2^64 / golden ratio: zero is no fixed point
  return mix64(mix64(seed + kGolden) + trial + kGolden);
}

constexpr Key pixel_key(std::uint64_t draw, Pixel pixel) noexcept {
  const auto x = static_cast<std::uint64_t>(pixel.x), y = static_cast<std::uint64_t>(pixel.y);
  const std::uint64_t h = mix64(mix64(draw + x) + y);
  return {{static_cast<std::uint32_t>(h), static_cast<std::uint32_t>(h >> 32), static_cast<std::uint32_t>(x),
           static_cast<std::uint32_t>(y)}};
}

// A word of 32 bits, or each of a vector of them, rotated by 0 < by < 32. In place: returned by value, vectors would
// have another calling convention on every instruction set.
template <class Word>
[[gnu::always_inline]] constexpr void rotate_left(Word& word, int by) noexcept {
  word = word << by | word >> (32 - by);
}

// Threefry4x32 as published, any number of rounds up to 20; a multiple of 4 ends with a key injection.
// a, b, c and d, each a word of 32 bits or a vector of them, hold the counter and become the result. Inlined always,
// and hash() too: otherwise clang leaves a call in the loop over samples, which is then not vectorised.
template <int rounds, class Word>
[[gnu::always_inline]] constexpr void threefry4x32(const Key& key, Word& a, Word& b, Word& c, Word& d) noexcept {
  static_assert(rounds >= 0 && rounds <= 20);
  constexpr int kRotations[8][2] = {{10, 26}, {11, 21}, {13, 27}, {23, 5}, {6, 20}, {17, 11}, {25, 10}, {18, 20}};
  const auto& k = key.words;
  const std::uint32_t schedule[5] = {k[0], k[1], k[2], k[3], 0x1BD11BDAu ^ k[0] ^ k[1] ^ k[2] ^ k[3]};
  a += k[0];
  b += k[1];
  c += k[2];
  d += k[3];
#pragma GCC unroll 20
  for (int r = 0; r < rounds; ++r) {
    if (r % 2 == 0) {
      a += b;
      rotate_left(b, kRotations[r % 8][0]);
      b ^= a;
      c += d;
      rotate_left(d, kRotations[r % 8][1]);
      d ^= c;
    } else {
      a += d;
      rotate_left(d, kRotations[r % 8][0]);
      d ^= a;
      c += b;
      rotate_left(b, kRotations[r % 8][1]);
      b ^= c;
    }
    if (r % 4 == 3) {
      const int j = r / 4 + 1;
      a += schedule[j % 5];
      b += schedule[(j + 1) % 5];
      c += schedule[(j + 2) % 5];
      d += schedule[(j + 3) % 5] + static_cast<std::uint32_t>(j);
    }
  }
}
template <int rounds>
[[gnu::always_inline]] constexpr Words threefry4x32(const Key& key, std::array<std::uint32_t, 4> counter) noexcept {
  auto [a, b, c, d] = counter;
  threefry4x32<rounds>(key, a, b, c, d);
  return {a, b, c, d};
}

// The random words of (key, index, axis). `part` goes on where 32 bits of index end.
[[gnu::always_inline]] constexpr Words hash(const Key& key, std::uint32_t index, Axis axis,
                                            std::uint32_t part = 0) noexcept {
  return threefry4x32<12>(key, {index, static_cast<std::uint32_t>(axis), part, 0});
}

// The leading 52 of 64 bits.
constexpr std::uint64_t digits52(std::uint32_t high, std::uint32_t low) noexcept {
  return static_cast<std::uint64_t>(high) << 20 | low >> 12;
}

// digits / 2^52 for digits < 2^52: exact, in [0, 1). Written into the fraction of a number in [1, 2), because AVX2 has
// no conversion from 64-bit integers.
constexpr double unit_from_digits(std::uint64_t digits) noexcept {
  return std::bit_cast<double>(0x3FF0000000000000u | digits) - 1.0;
}

// Uniform in [0, 1): a multiple of 2^-52.
constexpr double unit(std::uint32_t high, std::uint32_t low) noexcept { return unit_from_digits(digits52(high, low)); }

}  // namespace moire
