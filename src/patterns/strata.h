// Random points strictly inside equal strata of [0, 1), so that no rounding can move one into the next stratum.
#pragma once

#include <bit>
#include <cstdint>

#include "core/hash.h"

namespace moire {

// `cells` equal strata, 1 <= cells <= 2^30. With c = ceil(log2 cells), a stratum holds 2^(50-c) places, the odd
// multiples of 2^-(51-c) of its width. Their mean is exactly its middle.
//
// Why nothing crosses: cell + u has at most 51 bits, so it is exact, and it stays 2^-(51-c) away from both ends, a
// relative distance of at least 2^-51. The division by `cells` rounds by at most 2^-53 relative; even
// floor(place * cells), with one more rounding, gives back `cell`.
class Strata {
 public:
  explicit Strata(int cells) noexcept : cells_(cells) {
    const int c = static_cast<int>(std::bit_width(static_cast<unsigned>(cells - 1)));
    half_ = std::uint64_t{1} << (1 + c);
    keep_ = ~((half_ << 1) - 1);
  }

  // The numbers of [0, 1) moved to places in (0, 1), in units of a stratum's width.
  double offset(double u) const noexcept {
    const auto bits = std::bit_cast<std::uint64_t>(1.0 + u);
    return std::bit_cast<double>((bits & keep_) | half_) - 1.0;
  }

  // 1 + offset() of the uniform number digits / 2^52, without making that number first: takes digits < 2^52, a number
  // or a vector of them, and leaves the bits of a double.
  template <class Bits>
  [[gnu::always_inline]] void one_plus_offset(Bits& digits) const noexcept {
    digits = ((0x3FF0000000000000u | digits) & keep_) | half_;
  }

  // The coordinate of offset u in stratum `cell`, correctly rounded.
  double place(double cell, double u) const noexcept { return (cell + u) / cells_; }

  // Where there is a power of two of strata, 1 / cells is exact, and a product with it is what place() gives.
  bool has_exact_width() const noexcept { return std::has_single_bit(static_cast<std::uint64_t>(cells_)); }
  double width() const noexcept { return 1 / cells_; }

 private:
  double cells_;
  std::uint64_t half_, keep_;
};

}  // namespace moire
