// Binomial coefficients, as many as the terms of a series (euler_polynomials.h) need.
#pragma once

#include <array>
#include <cstddef>

#include "testimages/euler_polynomials.h"

namespace moire {

// kBinomials[n][k], n <= kMaxTerms + 2.
inline constexpr auto kBinomials = [] {
  constexpr std::size_t kMost = kMaxTerms + 2;
  std::array<std::array<double, kMost + 1>, kMost + 1> b{};
  for (std::size_t n = 0; n <= kMost; ++n) {
    b[n][0] = b[n][n] = 1;
    for (std::size_t k = 1; k < n; ++k) b[n][k] = b[n - 1][k - 1] + b[n - 1][k];
  }
  return b;
}();

}  // namespace moire
