// Reading a whole file.
#include "study/text_file.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>
#include <string_view>
#include <system_error>

#include "core/error.h"

namespace moire {
namespace {

Error unreadable(const std::string& path, std::string_view reason) {
  return Error(path, fmt::format("cannot be read ({}); give a readable file", reason), Exit::io);
}

}  // namespace

std::string read_bytes(const std::string& path, std::size_t max) {
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"), &std::fclose);
  if (!file) throw unreadable(path, std::strerror(errno));
  std::string bytes;
  for (char block[1 << 16];;) {
    const std::size_t got = std::fread(block, 1, sizeof block, file.get());
    if (got == 0) break;
    bytes.append(block, got);
    if (bytes.size() > max) {
      throw Error(path, fmt::format("cannot be read (it is above {} MiB); give a smaller file", max >> 20), Exit::io);
    }
  }
  if (std::ferror(file.get()) != 0) throw unreadable(path, std::strerror(errno));
  return bytes;
}

void require_regular_file(const std::string& path) {
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(path, error);
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status)) {
    throw unreadable(path, "it is no regular file");
  }
}

std::string read_named_file(const std::string& path, std::size_t max) {
  require_regular_file(path);
  return read_bytes(path, max);
}

}  // namespace moire
