// Files in memory as OpenImageIO reads them; part of the module moire_io.
#pragma once

#include <OpenImageIO/filesystem.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

namespace moire {

// The bytes are to stay. OpenImageIO 2.4's own reader reads before or behind them when it is sent beyond their end, as
// damaged offsets in a file do.
class MemoryReader : public OIIO::Filesystem::IOMemReader {
 public:
  explicit MemoryReader(std::span<const unsigned char> bytes)
      : IOMemReader(bytes.data(), bytes.size()), size_(bytes.size()) {}

  std::size_t read(void* to, std::size_t count) override {
    const std::size_t got = pread(to, count, tell());
    seek(tell() + static_cast<std::int64_t>(got));
    return got;
  }
  std::size_t pread(void* to, std::size_t count, std::int64_t at) override {
    if (at < 0 || static_cast<std::uint64_t>(at) >= size_) return 0;
    return IOMemReader::pread(to, std::min(count, size_ - static_cast<std::size_t>(at)), at);
  }

 private:
  std::size_t size_;
};

}  // namespace moire
