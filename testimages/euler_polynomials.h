// The repeated antiderivatives of a square wave: Euler polynomials (Digital Library of Mathematical Functions, 24.2 and
// 24.17). E_0 = s(u) = (-1)^floor(u) and E_(j+1)' = E_j, all antiperiodic; E_j is the Euler polynomial of degree j over
// j! on [0, 1).
#pragma once

#include <array>
#include <cstddef>

namespace moire {

inline constexpr int kMaxTerms = 16;

// E_j(1/2 + t) for |t| <= 1/2: the coefficients of t^i, z^j in e^(tz) sech(z/2), which are Euler numbers over
// factorials.
struct EulerPolynomials {
  std::array<std::array<double, kMaxTerms + 1>, kMaxTerms + 1> coefficient{};
  std::array<double, kMaxTerms + 1> sup{};   // of |E_j|: in the middle for even j, at the ends for odd j
  std::array<double, kMaxTerms + 1> size{};  // sum of |coefficient| 2^-i

  constexpr EulerPolynomials() {
    constexpr double kEulerNumbers[] = {1, -1, 5, -61, 1385, -50521, 2702765, -199360981, 19391512145};
    std::array<double, kMaxTerms + 1> factorial{1};
    for (std::size_t i = 1; i <= kMaxTerms; ++i) factorial[i] = factorial[i - 1] * static_cast<double>(i);
    for (std::size_t j = 0; j <= kMaxTerms; ++j) {
      double power = 1, end = 0;
      for (std::size_t i = 0; i <= j; ++i, power /= 2) {
        if ((j - i) % 2 != 0) continue;
        // Exact but for this division: factorials up to 16! and powers of two are doubles.
        double two = 1;
        for (std::size_t n = i; n < j; ++n) two *= 2;
        coefficient[j][i] = kEulerNumbers[(j - i) / 2] / (two * factorial[j - i] * factorial[i]);
        end += coefficient[j][i] * power;
        size[j] += (coefficient[j][i] < 0 ? -coefficient[j][i] : coefficient[j][i]) * power;
      }
      const double extreme = j % 2 == 0 ? coefficient[j][0] : end;
      sup[j] = (extreme < 0 ? -extreme : extreme) * (1 + 0x1p-40);
    }
  }
};
inline constexpr EulerPolynomials kEuler;

}  // namespace moire
