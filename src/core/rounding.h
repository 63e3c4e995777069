// The unit of every error bound: rounding to nearest changes a double by at most this share of itself.
#pragma once

namespace moire {

// u = 2^-53, half the distance from 1 to the next double.
inline constexpr double kUnit = 0x1p-53;

}  // namespace moire
