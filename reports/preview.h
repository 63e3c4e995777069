// Pictures of numbers: a reconstruction as the eye would see it, and a signed error in colours. Pixel for pixel, no
// scaling.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "core/geometry.h"
#include "reports/images.h"

namespace moire {

using Rgb = std::array<std::uint8_t, 3>;

// A value that is NaN is magenta in every preview, which then has 3 channels.
inline constexpr Rgb kNanColour{255, 0, 255};

// The sRGB transfer function, IEC 61966-2-1: linear [0, 1] to the nearest of 0..255; values outside are clipped.
std::uint8_t srgb8(double linear);
// Its inverse: the linear value that 0..255 stands for.
double linear_of_srgb8(std::uint8_t code);

// The diverging map's colour at `value` in [-1, 1] (beyond: the ends): blue for negative, neutral light grey at 0, red
// for positive. Control colours from Moreland, "Diverging color maps for scientific visualization", ISVC 2009, safe for
// the common colour-vision deficiencies; between them straight lines in CIELAB, so that steps look alike along the map.
Rgb diverging_colour(double value);

// Linear coverage to 8-bit grey. Text chunks: moire:kind "reconstruction", moire:transfer "sRGB", moire:clipped (the
// number of pixels outside [0, 1]) and moire:nan.
Raster reconstruction_preview(Grid grid, std::span<const float> coverage);

// Signed errors, linear in the map from -range to +range; an error of exactly 0 is exactly the neutral colour. `range`
// is the 99.5th percentile of |error| over the active pixels; where that is 0 though some pixel is wrong, the largest
// |error| takes its place. Text chunks: moire:kind "error", moire:range (the range used), moire:range_is ("p99.5 of
// |error| over active pixels" or "max |error|"), moire:map (in words), moire:clipped (pixels beyond the range),
// moire:nan.
Raster error_preview(Grid grid, std::span<const float> error, double range);

}  // namespace moire
