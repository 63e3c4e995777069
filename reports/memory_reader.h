// Files in memory as OpenImageIO reads them; part of the module moire_io.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

namespace moire {

// The bytes are to stay. `Reader` is OpenImageIO's IOMemReader, which headers do not know: that of 2.4 reads before or
// behind its bytes when it is sent beyond their end, as damaged offsets in a file do.
template <class Reader>
class MemoryReader : public Reader {
 public:
  explicit MemoryReader(std::span<const unsigned char> bytes)
      : Reader(bytes.data(), bytes.size()), size_(bytes.size()) {}

  std::size_t read(void* to, std::size_t count) override {
    const std::size_t got = pread(to, count, this->tell());
    this->seek(this->tell() + static_cast<std::int64_t>(got));
    return got;
  }
  std::size_t pread(void* to, std::size_t count, std::int64_t at) override {
    if (at < 0 || static_cast<std::uint64_t>(at) >= size_) return 0;
    return Reader::pread(to, std::min(count, size_ - static_cast<std::size_t>(at)), at);
  }

 private:
  std::size_t size_;
};

}  // namespace moire
