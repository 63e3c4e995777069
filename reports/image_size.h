// The size that an image file promises, before memory is taken for it, and its pixels; part of the module moire_io.
#pragma once

#include <string>

#include "reports/image_io.h"

namespace moire {

// What is wrong with the sides of an image, "" when they can be read.
inline std::string refuse_size(std::int64_t width, std::int64_t height) {
  if (width >= 1 && height >= 1 && width <= kMaxReadSide && height <= kMaxReadSide && width <= kMaxReadPixels / height)
    return {};
  return "has " + std::to_string(width) + " x " + std::to_string(height) + " pixels; at most " +
         std::to_string(kMaxReadPixels) + " can be read, " + std::to_string(kMaxReadSide) + " a side";
}

// The same of its planes and tiles, too. `Spec` is OpenImageIO's ImageSpec, which headers do not know.
template <class Spec>
std::string refuse_size(const Spec& spec) {
  const std::int64_t tile = std::int64_t{spec.tile_width} * spec.tile_height;
  if (tile > kMaxReadPixels) {
    return "has tiles of " + std::to_string(tile) + " pixels; at most " + std::to_string(kMaxReadPixels) +
           " can be read";
  }
  if (spec.depth > 1) return "has " + std::to_string(spec.depth) + " planes instead of one";
  return refuse_size(spec.width, spec.height);
}

// Reads all channels as samples of that type; false: in.geterror() says why. Row by row: whole images go through a
// buffer of 256 rows of any length. `Input` is OpenImageIO's ImageInput.
template <class Input, class Spec, class Type, class Sample>
bool read_pixels(Input& in, const Spec& spec, Type type, Sample* pixels) {
  if (spec.tile_width > 0) return in.read_image(0, 0, 0, spec.nchannels, type, pixels);
  const auto row = static_cast<std::size_t>(spec.width) * static_cast<std::size_t>(spec.nchannels);
  for (int y = 0; y < spec.height; ++y, pixels += row) {
    if (!in.read_scanline(spec.y + y, 0, type, pixels)) return false;
  }
  return true;
}

}  // namespace moire
