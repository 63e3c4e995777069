// How many of many tests came out 1.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <span>

namespace moire {

// The number of ones; every byte is 0 or 1. Eight at a time, in a word whose bytes do not overflow within 255 of them.
inline std::int64_t count_inside(std::span<const std::uint8_t> inside) noexcept {
  constexpr std::size_t kWord = 8, kMost = 255 * kWord;
  constexpr std::uint64_t kEvenBytes = 0x00FF00FF00FF00FFu;
  std::int64_t count = 0;
  std::size_t i = 0;
  while (i + kWord <= inside.size()) {
    const std::size_t end = i + std::min(kMost, (inside.size() - i) / kWord * kWord);
    std::uint64_t sums = 0;
    for (; i < end; i += kWord) {
      std::uint64_t word;
      std::memcpy(&word, inside.data() + i, kWord);
      sums += word;
    }
    // Pairs of bytes, then the product's leading 16 bits are the sum of all four.
    sums = (sums & kEvenBytes) + (sums >> 8 & kEvenBytes);
    count += static_cast<std::int64_t>(sums * 0x0001000100010001u >> 48);
  }
  for (; i < inside.size(); ++i) count += inside[i];
  return count;
}

}  // namespace moire
