// The door between the program and its module moire_io. Both are built together, by the same compiler.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "reports/images.h"

namespace moire {

using ImageBytes = std::vector<unsigned char>;

// Each returns what went wrong, empty when nothing did. Files are written to memory: a full disk is noticed by whoever
// puts the bytes there, which not every format's writer does.
struct ImageIo {
  std::string (*write_exr)(Grid grid, std::span<const float> y, const std::vector<Attribute>& attributes,
                           const std::string& software, ImageBytes& bytes);
  std::string (*read_exr)(const std::string& path, ExrImage& image);
  std::string (*write_png)(const Raster& raster, const std::string& software, ImageBytes& bytes);
  std::string (*read_png)(const std::string& path, Raster& raster);
};

// The module's functions, by file.
std::string write_exr_file(Grid grid, std::span<const float> y, const std::vector<Attribute>& attributes,
                           const std::string& software, ImageBytes& bytes);
std::string read_exr_file(const std::string& path, ExrImage& image);
std::string write_png_file(const Raster& raster, const std::string& software, ImageBytes& bytes);
std::string read_png_file(const std::string& path, Raster& raster);

}  // namespace moire

// The module's one entry point, and the one name that it shows.
extern "C" [[gnu::visibility("default")]] const moire::ImageIo* moire_io();
