// What the fuzz targets share. A target gets any bytes and must read them or throw Error; everything else that it
// throws, and every promise that does not hold afterwards, ends the program.
#pragma once

#include <sys/mman.h>
#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>

#include "core/error.h"

// libFuzzer's entry point: called with one input after the other; returns 0.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace moire::fuzz {

// Ends the program with a message unless the promise holds.
inline void require(bool holds, const char* promise) {
  if (holds) return;
  std::fprintf(stderr, "fuzz: broken promise: %s\n", promise);
  std::abort();
}

inline std::string_view text_of(const std::uint8_t* data, std::size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

// Runs `body`. An Error must say something and end with the code of bad input, or of bad input/output.
template <class F>
int run_target(F&& body) {
  try {
    body();
  } catch (const Error& e) {
    require(e.what()[0] != '\0', "an error says what is wrong");
    require(e.code() == Exit::usage || e.code() == Exit::io, "bad input ends with code 2 or 3");
  }
  return 0;
}

// Bytes as a file that readers can open by its path; in memory alone.
class MemoryFile {
 public:
  MemoryFile(const std::uint8_t* data, std::size_t size) : file_(::memfd_create("input", MFD_CLOEXEC)) {
    require(file_ >= 0 && ::write(file_, data, size) == static_cast<ssize_t>(size), "the system has memory files");
  }
  ~MemoryFile() { ::close(file_); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  std::string path() const { return "/proc/self/fd/" + std::to_string(file_); }

 private:
  int file_;
};

}  // namespace moire::fuzz
