// Files that appear whole.
#include "reports/file.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <system_error>

#include "core/error.h"

namespace moire {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const std::string& path, const std::string& what, const std::string& reason) {
  throw Error(path, what + ": " + reason, Exit::io);
}

void write_plain(const std::string& path, std::string_view bytes, const std::string& named) {
  std::FILE* file = std::fopen(path.c_str(), "wb");
  if (file == nullptr) fail(named, "cannot be written", std::strerror(errno));
  errno = 0;
  const bool written = std::fwrite(bytes.data(), 1, bytes.size(), file) == bytes.size();
  const int write_error = errno;
  // A full disk may show only when the last bytes leave the buffer.
  const bool closed = std::fclose(file) == 0;
  if (!written || !closed) fail(named, "cannot be written", std::strerror(written ? errno : write_error));
}

// The file that `path` means: the end of a chain of symbolic links, which renaming would cut.
fs::path resolve(const std::string& path) {
  std::error_code error;
  if (fs::is_symlink(path, error)) {
    const fs::path target = fs::weakly_canonical(path, error);
    if (!error) return target;
  }
  return path;
}

}  // namespace

void write_whole(const std::string& path, std::string_view bytes) {
  const fs::path target = resolve(path);
  std::error_code error;
  const fs::file_status status = fs::status(target, error);
  if (fs::is_directory(status)) fail(path, "cannot be written", "it is a folder");
  if (fs::exists(status) && !fs::is_regular_file(status)) return write_plain(target.string(), bytes, path);

  // File systems take names of 255 bytes; names alike in their first 250 must not be written at the same time.
  const fs::path part = target.parent_path() / (target.filename().string().substr(0, 250) + ".part");
  try {
    write_plain(part.string(), bytes, path);
  } catch (const Error&) {
    fs::remove(part, error);
    throw;
  }
  fs::rename(part, target, error);
  if (error) {
    const std::string reason = error.message();
    fs::remove(part, error);
    fail(path, "cannot be written", reason);
  }
}

void make_folder(const std::string& path) {
  std::error_code error;
  fs::create_directories(path, error);
  if (error) fail(path, "cannot be made a folder", error.message());
  // create_directories is content with a link to a file in its way.
  if (!fs::is_directory(path, error)) fail(path, "cannot be made a folder", "a file stands there");
}

}  // namespace moire
