// Binary digits mirrored at the point: the radical inverse in base 2 (J. G. van der Corput, "Verteilungsfunktionen",
// Proc. Ned. Akad. v. Wet. 38, 1935).
#pragma once

#include <cstdint>

namespace moire {

// phi_2(i) * 2^32: digit k of i (k = 0 is the least significant) becomes the (k + 1)-th digit after the point.
constexpr std::uint32_t radical_inverse32(std::uint32_t i) noexcept {
  i = i << 16 | i >> 16;
  i = (i & 0x00FF00FFu) << 8 | (i & 0xFF00FF00u) >> 8;
  i = (i & 0x0F0F0F0Fu) << 4 | (i & 0xF0F0F0F0u) >> 4;
  i = (i & 0x33333333u) << 2 | (i & 0xCCCCCCCCu) >> 2;
  return (i & 0x55555555u) << 1 | (i & 0xAAAAAAAAu) >> 1;
}

}  // namespace moire
