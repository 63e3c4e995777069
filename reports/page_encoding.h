// Images as a page holds them: values of 32 or 16 bits (IEEE 754-2019), their bytes in planes where that makes them
// smaller, gzip, base64.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "core/geometry.h"

namespace moire {

// The nearest half, ties to even; infinite from 65520 on. A NaN stays one.
std::uint16_t half_bits(float value);

// Byte planes: the lowest bytes of all values, then the next ones, ... bytes.size() is a multiple of `width`, the bytes
// of a value. Numbers that are near each other then have runs of equal bytes.
std::string shuffled(std::string_view bytes, std::size_t width);

// Stored values, little-endian; value = stored * scale.
struct EncodedPixels {
  Grid grid;
  bool half = false;
  bool shuffle = false, gzip = false;
  double scale = 1;       // a power of two
  std::string data = {};  // base64
};

// Bits kept; for exact images, which a page shows to the last digit.
EncodedPixels encode_floats(Grid grid, std::span<const float> values);

// Rounded to 11 bits: for spectra, and for signed errors, of which a page takes means of squares that are then right to
// some 1e-6, which those of differences of rounded images would not be. The largest finite |value| is stored from 2^14
// on to below 2^15, so that all down to 2^-28 of it keep their 11 bits, and smaller ones are right to 2^-39 of it.
EncodedPixels encode_halves(Grid grid, std::span<const float> values);

}  // namespace moire
