// Images as a page holds them.
#include "reports/page_encoding.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "reports/gzip.h"

namespace moire {
namespace {

template <class T>
void append_little_endian(T bits, std::string& bytes) {
  for (std::size_t b = 0; b < sizeof(T); ++b) bytes += static_cast<char>(bits >> (8 * b) & 0xffU);
}

// The smallest of the three forms; of forms alike the simplest.
void pack(const std::string& bytes, std::size_t width, EncodedPixels& image) {
  const std::string plain = gzip(bytes), planes = gzip(shuffled(bytes, width));
  image.shuffle = planes.size() < plain.size() && planes.size() < bytes.size();
  image.gzip = image.shuffle || plain.size() < bytes.size();
  image.data = base64(image.shuffle ? planes : image.gzip ? plain : bytes);
}

}  // namespace

std::uint16_t half_bits(float value) {
  const auto bits = std::bit_cast<std::uint32_t>(value);
  const auto sign = static_cast<std::uint16_t>(bits >> 16 & 0x8000U);
  const std::uint32_t magnitude = bits & 0x7fffffffU;
  if (magnitude > 0x7f800000U) return static_cast<std::uint16_t>(sign | 0x7e00U);
  if (magnitude >= 0x477ff000U) return static_cast<std::uint16_t>(sign | 0x7c00U);  // 65520: half way to 65536
  if (magnitude < 0x38800000U) {                                                    // 2^-14: subnormal, or 0
    // In units of 2^-24 the value is at most 1024: adding 2^23 leaves its integer, rounded to even, in the low bits.
    const float shifted = std::bit_cast<float>(magnitude) * 0x1p24F + 0x1p23F;
    return static_cast<std::uint16_t>(sign | (std::bit_cast<std::uint32_t>(shifted) & 0x7ffU));
  }
  // 13 bits go; a carry out of the fraction raises the exponent, as it should. Exponents differ by 127 - 15.
  const std::uint32_t rounded = magnitude + 0xfffU + (magnitude >> 13 & 1U);
  return static_cast<std::uint16_t>(sign | ((rounded - (112U << 23)) >> 13));
}

std::string shuffled(std::string_view bytes, std::size_t width) {
  std::string planes;
  planes.reserve(bytes.size());
  for (std::size_t plane = 0; plane < width; ++plane) {
    for (std::size_t i = plane; i < bytes.size(); i += width) planes += bytes[i];
  }
  return planes;
}

EncodedPixels encode_floats(Grid grid, std::span<const float> values) {
  EncodedPixels image{.grid = grid};
  std::string bytes;
  bytes.reserve(4 * values.size());
  for (const float value : values) append_little_endian(std::bit_cast<std::uint32_t>(value), bytes);
  pack(bytes, 4, image);
  return image;
}

EncodedPixels encode_halves(Grid grid, std::span<const float> values) {
  EncodedPixels image{.grid = grid, .half = true};
  float largest = 0;
  for (const float value : values) {
    if (std::isfinite(value)) largest = std::max(largest, std::fabs(value));
  }
  const int shift = largest > 0 ? 14 - std::ilogb(largest) : 0;
  image.scale = std::ldexp(1.0, -shift);
  std::string bytes;
  bytes.reserve(2 * values.size());
  // In double: a shift of an error near the smallest float is beyond the largest one. The product is exact, or so small
  // that it is far below half of the smallest half.
  for (const float value : values) {
    append_little_endian(half_bits(static_cast<float>(std::ldexp(static_cast<double>(value), shift))), bytes);
  }
  pack(bytes, 2, image);
  return image;
}

}  // namespace moire
