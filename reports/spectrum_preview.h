// Pictures of power spectra, zero frequency in the middle.
#pragma once

#include <span>

#include "core/geometry.h"
#include "reports/images.h"

namespace moire {

// How power becomes brightness. Both scales are linear light, written with the sRGB transfer function.
enum class PowerScale {
  // 0 to kPowerClip is black to white, what is above is white: for point sets, where 1 is the power of random points
  // and looks like a middle grey.
  linear,
  // kDecades powers of ten below the largest power are black to white, evenly on the sRGB scale, what is below is
  // black: for errors of images, whose power falls by many powers of ten.
  logarithmic,
};
inline constexpr double kPowerClip = 4;
inline constexpr double kDecades = 6;

// `power` is row-major with zero frequency at column width / 2 and row height / 2 (integer division). Zero frequency is
// not shown: its bin is black, and counts for no range. Text chunks: moire:kind "spectrum", moire:scale ("linear" or
// "log10"), moire:range (the powers that are black and white, "LO HI"), moire:dc ("blanked"), moire:clipped (bins
// above the range), moire:nan (NaN is magenta, preview.h).
Raster spectrum_preview(Grid grid, std::span<const float> power, PowerScale scale);

}  // namespace moire
