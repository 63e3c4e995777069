// Sums of doubles and of products of two doubles without any error, as one long number in fixed point: Kulisch,
// "Computer Arithmetic and Validity", 2008, chapter 8. It knows nothing of error-free transformations, which it judges.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "oracle/quad.h"

namespace moire::stress {

class ExactSum {
 public:
  // Finite numbers only.
  void add(double x) {
    int exponent = 0;
    const std::int64_t m = digits(x, exponent);
    add_digits(static_cast<std::uint64_t>(m < 0 ? -m : m), exponent, m < 0);
  }
  void add_product(double a, double b) {
    int ea = 0, eb = 0;
    const std::int64_t ma = digits(a, ea), mb = digits(b, eb);
    const auto la = static_cast<std::uint64_t>(ma < 0 ? -ma : ma), lb = static_cast<std::uint64_t>(mb < 0 ? -mb : mb);
    __extension__ const unsigned __int128 product = static_cast<unsigned __int128>(la) * lb;
    const bool negative = (ma < 0) != (mb < 0);
    add_digits(static_cast<std::uint64_t>(product), ea + eb, negative);
    add_digits(static_cast<std::uint64_t>(product >> 64), ea + eb + 64, negative);
  }

  // Within 2^-111 of the sum, relative.
  oracle::Quad value() const {
    ExactSum s = *this;
    const bool negative = s.make_positive();
    std::size_t top = kLimbs;
    while (top > 0 && s.limbs_[top - 1] == 0) --top;
    oracle::Quad sum = 0;
    // Five limbs have at least 129 bits.
    for (std::size_t i = 0; i < 5 && i < top; ++i) {
      const std::size_t limb = top - 1 - i;
      sum += static_cast<oracle::Quad>(s.limbs_[limb]) * power_of_two(kLimbBits * static_cast<int>(limb) - kPoint);
    }
    return negative ? -sum : sum;
  }
  // |computed - the sum|, as value() is.
  oracle::Quad distance_to(double computed) const {
    ExactSum s = *this;
    s.add(-computed);
    return oracle::abs(s.value());
  }

  static oracle::Quad power_of_two(int n) {
    oracle::Quad result = 1, base = n < 0 ? oracle::Quad(1) / 2 : oracle::Quad(2);
    for (int left = n < 0 ? -n : n; left > 0; left /= 2, base *= base) {
      if (left % 2 != 0) result *= base;
    }
    return result;
  }

 private:
  // The last digit of the smallest product of doubles is worth 2^-2148, the largest product is below 2^2048.
  static constexpr int kLimbBits = 32, kPoint = 72 * kLimbBits;
  static constexpr std::size_t kLimbs = 140;

  // x = result * 2^exponent.
  static std::int64_t digits(double x, int& exponent) {
    const double fraction = std::frexp(x, &exponent);
    exponent -= 53;
    return static_cast<std::int64_t>(std::ldexp(fraction, 53));
  }
  void add_digits(std::uint64_t digits, int exponent, bool negative) {
    const int place = exponent + kPoint;
    const auto limb = static_cast<std::size_t>(place / kLimbBits);
    __extension__ const unsigned __int128 shifted = static_cast<unsigned __int128>(digits) << (place % kLimbBits);
    for (std::size_t i = 0; i < 3; ++i) {
      const auto part = static_cast<std::int64_t>(static_cast<std::uint64_t>(shifted >> (kLimbBits * i)) & 0xFFFFFFFFu);
      limbs_[limb + i] += negative ? -part : part;
    }
    if (++added_ == (1 << 28)) carry();  // limbs hold 2^31 parts
  }
  void carry() {
    std::int64_t carry = 0;
    for (std::size_t i = 0; i + 1 < kLimbs; ++i) {
      const std::int64_t all = limbs_[i] + carry;
      carry = all >> kLimbBits;  // rounds down, also below zero
      limbs_[i] = all - (carry << kLimbBits);
    }
    limbs_[kLimbs - 1] += carry;
    added_ = 0;
  }
  // All limbs >= 0; whether the sum was negative.
  bool make_positive() {
    carry();
    if (limbs_[kLimbs - 1] >= 0) return false;
    for (std::int64_t& limb : limbs_) limb = -limb;
    carry();
    return true;
  }

  std::array<std::int64_t, kLimbs> limbs_{};
  int added_ = 0;
};

}  // namespace moire::stress
