// The exact sign of a sum of doubles and of products of two doubles.
//
// Shewchuk, "Adaptive precision floating-point arithmetic and fast robust geometric predicates", Discrete &
// Computational Geometry 18, 1997: a number as a sum of doubles that do not overlap, grown one term at a time. Exact
// as long as nothing overflows and no product falls below 2^-969 (then its rounding error can not be represented).
#pragma once

#include <array>
#include <cassert>
#include <cstddef>

#include "core/double_double.h"

namespace moire {

class Expansion {
 public:
  void add(double b) {
    std::size_t kept = 0;
    double q = b;
    for (std::size_t i = 0; i < size_; ++i) {
      const Dd s = two_sum(q, terms_[i]);
      q = s.hi;
      if (s.lo != 0) terms_[kept++] = s.lo;  // zeros are dropped, so that the capacity is never reached by them
    }
    if (q != 0) terms_[kept++] = q;
    size_ = kept;
    assert(size_ <= kCapacity);
  }

  void add_product(double a, double b) {
    const Dd p = two_prod(a, b);
    add(p.lo);
    add(p.hi);
  }

  // -1, 0 or 1: that of the largest term, which comes last.
  int sign() const {
    if (size_ == 0) return 0;
    return terms_[size_ - 1] > 0 ? 1 : -1;
  }

 private:
  // Non-overlapping doubles span at most 2098 bits, 53 each: 40 terms, one more while growing.
  static constexpr std::size_t kCapacity = 48;
  std::array<double, kCapacity> terms_{};
  std::size_t size_ = 0;
};

}  // namespace moire
