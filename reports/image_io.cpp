// The entry point of the module moire_io.
#include "reports/image_io.h"

extern "C" const moire::ImageIo* moire_io() {
  static constexpr moire::ImageIo kTable{moire::write_exr_file, moire::read_exr_file, moire::write_png_file,
                                         moire::read_png_file};
  return &kTable;
}
