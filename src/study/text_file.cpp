// Reading a whole text file.
#include "study/text_file.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>

#include "core/error.h"

namespace moire {

std::string read_text(const std::string& path) {
  constexpr std::size_t kMaxBytes = std::size_t{256} << 20;  // also an end to what never ends, such as /dev/zero
  const auto fail = [&](int reason) {
    return Error(path, fmt::format("the file cannot be read ({}); give a readable file", std::strerror(reason)),
                 Exit::io);
  };
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"), &std::fclose);
  if (!file) throw fail(errno);
  std::string bytes;
  for (char block[1 << 16];;) {
    const std::size_t got = std::fread(block, 1, sizeof block, file.get());
    if (got == 0) break;
    bytes.append(block, got);
    if (bytes.size() > kMaxBytes) throw Error(path, "the file is above 256 MiB; give a smaller one", Exit::io);
  }
  if (std::ferror(file.get()) != 0) throw fail(errno);
  return bytes;
}

}  // namespace moire
