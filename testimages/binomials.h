// Binomial coefficients, as many as series and their bounds need.
#pragma once

#include <array>
#include <cstddef>

namespace moire {

// kBinomials[n][k], n <= 25: all of them are doubles.
inline constexpr auto kBinomials = [] {
  constexpr std::size_t kMost = 25;
  std::array<std::array<double, kMost + 1>, kMost + 1> b{};
  for (std::size_t n = 0; n <= kMost; ++n) {
    b[n][0] = b[n][n] = 1;
    for (std::size_t k = 1; k < n; ++k) b[n][k] = b[n - 1][k - 1] + b[n - 1][k];
  }
  return b;
}();

}  // namespace moire
