// Random choices of one case: a stream of numbers that depends on (seed, family, case) alone.
#pragma once

#include <cmath>
#include <cstdint>
#include <iterator>
#include <string_view>

#include "core/hash.h"
#include "stress/family.h"

namespace moire::stress {

class Chance {
 public:
  Chance(std::string_view family, CaseKey key) {
    state_ = mix64(key.seed);
    for (const char c : family) state_ = mix64(state_ + static_cast<unsigned char>(c));
    state_ = mix64(state_ + key.index);
  }

  std::uint64_t bits() { return mix64(state_ += 0x9E3779B97F4A7C15u); }
  // Uniform in [0, 1), 53 bits.
  double unit() { return static_cast<double>(bits() >> 11) * 0x1p-53; }
  // Uniform in [lo, hi), up to rounding.
  double between(double lo, double hi) { return lo + (hi - lo) * unit(); }
  // Logarithmically uniform in [lo, hi), both > 0.
  double decades(double lo, double hi) { return std::exp(between(std::log(lo), std::log(hi))); }
  // 0 .. count-1; the bias, count / 2^64, is of no concern here.
  std::uint64_t below(std::uint64_t count) { return bits() % count; }
  bool coin() { return (bits() >> 63) != 0; }
  double sign() { return coin() ? 1 : -1; }
  template <class List>
  const auto& pick(const List& list) {
    return list[below(std::size(list))];
  }

 private:
  std::uint64_t state_;
};

}  // namespace moire::stress
