// Image files, by the module moire_io.
#include "reports/images.h"

#include <dlfcn.h>
#include <sys/mman.h>

#include <cassert>
#include <filesystem>
#include <new>
#include <string_view>
#include <system_error>

#include "core/error.h"
#include "reports/file.h"
#include "reports/image_io.h"
#include "reports/provenance.h"
#include "study/text_file.h"

namespace moire {
namespace {

// Whether the process may have so many bytes more, or addresses alone. Nothing of it is touched: no page is cleared,
// and threads on other cores need not be told that it is gone.
bool has_room(std::size_t bytes, int access) {
  void* const room = ::mmap(nullptr, bytes, access, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (room == MAP_FAILED) return false;
  ::munmap(room, bytes);
  return true;
}

// Throws where there is no room for the module: its libraries, 261 on Debian 12, take 390 MiB of addresses, and where
// that fails in the middle of their static constructors, some of them end the program. Nothing is taken but addresses.
void require_addresses() {
  constexpr std::size_t kMebibytes = 448;
  if (has_room(kMebibytes << 20, PROT_NONE)) return;
  throw Error("memory",
              "image files need " + std::to_string(kMebibytes) +
                  " MiB of addresses for their libraries; allow more, or write no images",
              Exit::io);
}

// The module stays open to the end: its libraries leave threads behind that must not lose their code.
const ImageIo& open_module() {
  std::error_code error;
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", error);
  if (error) throw Error("/proc/self/exe", "cannot be read: " + error.message(), Exit::io);
  const std::string path = (program.parent_path() / "moire_io.so").string();
  require_addresses();
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

// Of a file that is read: float pixels as many as can be read, and what the formats add.
constexpr std::size_t kMaxImageBytes = std::size_t{512} << 20;

std::span<const unsigned char> span_of(const std::string& bytes) {
  return {reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size()};
}

std::string_view text_of(const ImageBytes& bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

std::string software() { return "moire " + tool().version; }

// Throws std::bad_alloc unless there is memory for the formats' libraries to work on an image of `values`. Where it
// ends in the middle of their work some of them end the program.
void require_memory(std::size_t values) {
  constexpr std::size_t kOfLibraries = std::size_t{64} << 20, kOfValue = 16;    // buffers, threads; copies of the image
  const std::size_t images = values <= 3 * kSmallImage ? kWrittenTogether : 1;  // three channels at most
  if (!has_room(kOfLibraries + kOfValue * values * images, PROT_READ | PROT_WRITE)) throw std::bad_alloc();
}

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
  require_memory(y.size());
  check(path, "cannot be written", image_io().write_exr(grid, y, attributes, software(), bytes));
  write_whole(path, text_of(bytes));
}

ExrImage read_exr(const std::string& path) {
  ExrImage image;
  const std::string bytes = read_bytes(path, kMaxImageBytes);
  require_memory(bytes.size());
  check(path, "cannot be read", image_io().read_exr(span_of(bytes), image));
  return image;
}

void write_png(const std::string& path, const Raster& raster) {
  assert(raster.channels == 1 || raster.channels == 3);
  assert(raster.pixels.size() == static_cast<std::size_t>(raster.grid.width) *
                                     static_cast<std::size_t>(raster.grid.height) *
                                     static_cast<std::size_t>(raster.channels));
  ImageBytes bytes;
  require_memory(raster.pixels.size());
  check(path, "cannot be written", image_io().write_png(raster, software(), bytes));
  write_whole(path, text_of(bytes));
}

Raster read_png(const std::string& path) {
  Raster raster;
  const std::string bytes = read_bytes(path, kMaxImageBytes);
  require_memory(bytes.size());
  check(path, "cannot be read", image_io().read_png(span_of(bytes), raster));
  return raster;
}

}  // namespace moire
