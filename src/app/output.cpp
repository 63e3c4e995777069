// Standard output, where a short write is an error, notes to a person, and checks of paths before long work.
#include "app/output.h"

#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <system_error>

#include "core/error.h"

namespace moire {
namespace {

Error output_error() {
  return Error("standard output", std::string("cannot be written: ") + std::strerror(errno), Exit::io);
}

}  // namespace

void print(std::string_view text) {
  if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size()) throw output_error();
}

void say(const std::string& place, const std::string& what) {
  std::fputs(("note: " + place + ": " + what + "\n").c_str(), stderr);
}

void flush_output() {
  if (std::fflush(stdout) != 0) throw output_error();
}

void check_image_path(const std::string& option, const std::string& path) {
  if (path.empty()) return;
  if (!path.ends_with(".exr")) throw Error(option, "\"" + path + "\" is no EXR file; give a name that ends in .exr");
  std::filesystem::path folder = std::filesystem::path(path).parent_path();
  if (folder.empty()) folder = ".";
  std::error_code none;  // what cannot be asked about is no folder; writing will say what is wrong
  if (std::filesystem::is_directory(path, none)) throw Error(path, "cannot be written: it is a folder", Exit::io);
  if (::access(folder.c_str(), W_OK | X_OK) != 0) {
    throw Error(path, "cannot be written: folder " + folder.string() + ": " + std::strerror(errno), Exit::io);
  }
}

}  // namespace moire
