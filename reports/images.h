// Image files: float EXR and 8-bit PNG. OpenImageIO does the work, in the module moire_io beside the program, which is
// opened at the first image: linking it would cost every start of the program about 0.2 s.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "core/geometry.h"

namespace moire {

// What an EXR file says about its image, e.g. "moire:spp". Integers beyond 32 bits are written as text, and an
// empty text reads back as missing.
using Attribute = std::pair<std::string, std::variant<std::int64_t, double, std::string>>;

// One linear channel Y, row-major.
struct ExrImage {
  Grid grid;
  std::vector<float> y;
  std::vector<Attribute> attributes;  // those whose name begins with "moire:", and Software
};

// An 8-bit image, row-major, sRGB: 1 channel (grey) or 3 (red, green, blue), with text chunks: a keyword of 1 to 79
// characters and its text.
struct Raster {
  Grid grid;
  int channels = 1;
  std::vector<std::uint8_t> pixels;  // width * height * channels
  std::vector<std::pair<std::string, std::string>> text;
};

// The files appear whole (file.h), in the format of the function, whatever the name. The same image and attributes give
// the same bytes; no time stamps. `Software` is added. All throw Error (Exit::io) naming path and reason.

// Images of so many pixels or fewer may be written by several threads, up to kWrittenTogether at a time.
inline constexpr std::size_t kSmallImage = std::size_t{1} << 20, kWrittenTogether = 4;

// float32, ZIP; every value keeps its bits, NaN and infinities too.
void write_exr(const std::string& path, Grid grid, std::span<const float> y, const std::vector<Attribute>& attributes);
ExrImage read_exr(const std::string& path);

void write_png(const std::string& path, const Raster& raster);
Raster read_png(const std::string& path);

}  // namespace moire
