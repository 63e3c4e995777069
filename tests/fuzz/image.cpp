// Images given to `moire spectrum`: bytes as the module moire_io reads them, as EXR and as PNG.
#include "fuzz.h"
#include "reports/image_io.h"

using namespace moire;

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size > (1 << 16)) return 0;
  const std::span<const unsigned char> bytes(data, size);
  ExrImage exr;
  if (read_exr_file(bytes, exr).empty()) {
    fuzz::require(exr.grid.width > 0 && exr.grid.height > 0, "an image has pixels");
    fuzz::require(exr.y.size() == static_cast<std::size_t>(exr.grid.width) * static_cast<std::size_t>(exr.grid.height),
                  "each of them has a value");
  }
  Raster png;
  if (read_png_file(bytes, png).empty()) {
    fuzz::require(png.grid.width > 0 && png.grid.height > 0 && png.channels > 0, "an image has pixels");
    fuzz::require(png.pixels.size() == static_cast<std::size_t>(png.grid.width) *
                                           static_cast<std::size_t>(png.grid.height) *
                                           static_cast<std::size_t>(png.channels),
                  "each of them has its channels");
  }
  return 0;
}
