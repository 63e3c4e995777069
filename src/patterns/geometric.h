// How many misses in a row: geometric random numbers by inversion, G = floor(-ln(1 - U) / -ln(1 - p)), after L.
// Devroye, "Non-uniform random variate generation", 1986, chapter X.2. The logarithms are written out because those of
// the C library differ between processors with and without fused multiply-adds.
#pragma once

#include <bit>
#include <cstdint>
#include <limits>

namespace moire {

// 2 atanh(s), |s| <= 1/3, with a relative error below 2^-50: the power series, whose first dropped term is 3^-32 / 33
// of the first one.
[[gnu::always_inline]] inline double twice_atanh(double s) noexcept {
  const double z = s * s;
  double series = 1.0 / 31;
  for (int k = 14; k >= 0; --k) series = series * z + 1.0 / (2 * k + 1);
  return 2 * s * series;
}

// -ln x for normal x in (0, 1], with a relative error below 2^-49. Loops over it vectorise.
[[gnu::always_inline]] inline double minus_log(double x) noexcept {
  // x = 2^e m with m from sqrt(1/2) to sqrt 2; e + 2048 is what stands above the fraction.
  constexpr std::uint64_t kOffset = (std::uint64_t{2048} << 52) - std::bit_cast<std::uint64_t>(0.70710678118654752);
  const auto bits = std::bit_cast<std::uint64_t>(x);
  const std::uint64_t raised = (bits + kOffset) >> 52;
  const double m = std::bit_cast<double>(bits - ((raised - 2048) << 52));
  // An integer below 2^52 in the fraction of 2^52: AVX2 has no conversion from 64-bit integers.
  const double e = std::bit_cast<double>(0x4330000000000000u | raised) - (0x1p52 + 2048);
  return -(e * 0x1.62e42fefa39efp-1 + twice_atanh((m - 1) / (m + 1)));
}

// -ln(1 - part / whole) for 0 <= part <= whole <= 2^53: from 0 to infinity, with a relative error below 2^-49.
inline double miss_rate(std::uint64_t part, std::uint64_t whole) noexcept {
  const auto p = static_cast<double>(part), w = static_cast<double>(whole);
  if (part == whole) return std::numeric_limits<double>::infinity();
  return 2 * part <= whole ? twice_atanh(p / (2 * w - p)) : minus_log((w - p) / w);
}

}  // namespace moire
