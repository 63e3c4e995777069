// Image files, by the module moire_io.
#include "reports/images.h"

#include <dlfcn.h>

#include <cassert>
#include <filesystem>
#include <string_view>
#include <system_error>

#include "core/error.h"
#include "reports/file.h"
#include "reports/image_io.h"
#include "reports/provenance.h"

namespace moire {
namespace {

// The module stays open to the end: its libraries leave threads behind that must not lose their code.
const ImageIo& open_module() {
  std::error_code error;
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", error);
  if (error) throw Error("/proc/self/exe", "cannot be read: " + error.message(), Exit::io);
  const std::string path = (program.parent_path() / "moire_io.so").string();
  void* module = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (module == nullptr) {
    throw Error(
        path,
        std::string("the module for image files cannot be opened: ") + dlerror() + "; it belongs beside the program",
        Exit::io);
  }
  void* entry = dlsym(module, "moire_io");
  if (entry == nullptr) throw Error(path, "is not the module for image files", Exit::io);
  return *reinterpret_cast<decltype(&moire_io)>(entry)();
}

const ImageIo& image_io() {
  static const ImageIo& io = open_module();
  return io;
}

std::string_view text_of(const ImageBytes& bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

std::string software() { return "moire " + tool().version; }

// Throws what OpenImageIO says, on one line.
void check(const std::string& path, const char* what, std::string reason) {
  if (reason.empty()) return;
  while (!reason.empty() && reason.back() == '\n') reason.pop_back();
  for (char& c : reason) {
    if (c == '\n') c = ' ';
  }
  throw Error(path, std::string(what) + ": " + reason, Exit::io);
}

}  // namespace

void write_exr(const std::string& path, Grid grid, std::span<const float> y, const std::vector<Attribute>& attributes) {
  assert(y.size() == static_cast<std::size_t>(grid.width) * static_cast<std::size_t>(grid.height));
  ImageBytes bytes;
  check(path, "cannot be written", image_io().write_exr(grid, y, attributes, software(), bytes));
  write_whole(path, text_of(bytes));
}

ExrImage read_exr(const std::string& path) {
  ExrImage image;
  check(path, "cannot be read", image_io().read_exr(path, image));
  return image;
}

void write_png(const std::string& path, const Raster& raster) {
  assert(raster.channels == 1 || raster.channels == 3);
  assert(raster.pixels.size() == static_cast<std::size_t>(raster.grid.width) *
                                     static_cast<std::size_t>(raster.grid.height) *
                                     static_cast<std::size_t>(raster.channels));
  ImageBytes bytes;
  check(path, "cannot be written", image_io().write_png(raster, software(), bytes));
  write_whole(path, text_of(bytes));
}

Raster read_png(const std::string& path) {
  Raster raster;
  check(path, "cannot be read", image_io().read_png(path, raster));
  return raster;
}

}  // namespace moire
