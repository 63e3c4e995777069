// The door between the program and its module moire_io. Both are built together, by the same compiler.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "reports/images.h"

namespace moire {

using ImageBytes = std::vector<unsigned char>;

// Pixels of an image that is read. What its first bytes promise is held against this before memory is taken.
inline constexpr std::int64_t kMaxReadPixels = std::int64_t{1} << 26, kMaxReadSide = std::int64_t{1} << 20;

// Each returns what went wrong, empty when nothing did. Files are written to memory: a full disk is noticed by whoever
// puts the bytes there, which not every format's writer does. They are read from memory, as the one format of the
// function: from a path, OpenImageIO would try all its formats, whatever the name says.
struct ImageIo {
  std::string (*write_exr)(Grid grid, std::span<const float> y, const std::vector<Attribute>& attributes,
                           const std::string& software, ImageBytes& bytes);
  std::string (*read_exr)(std::span<const unsigned char> bytes, ExrImage& image);
  std::string (*write_png)(const Raster& raster, const std::string& software, ImageBytes& bytes);
  std::string (*read_png)(std::span<const unsigned char> bytes, Raster& raster);
};

// The module's functions, by file.
std::string write_exr_file(Grid grid, std::span<const float> y, const std::vector<Attribute>& attributes,
                           const std::string& software, ImageBytes& bytes);
std::string read_exr_file(std::span<const unsigned char> bytes, ExrImage& image);
std::string write_png_file(const Raster& raster, const std::string& software, ImageBytes& bytes);
std::string read_png_file(std::span<const unsigned char> bytes, Raster& raster);

}  // namespace moire

// The module's one entry point, and the one name that it shows.
extern "C" [[gnu::visibility("default")]] const moire::ImageIo* moire_io();
