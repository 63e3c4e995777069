// Reading a whole file.
#pragma once

#include <cstddef>
#include <string>

namespace moire {

// Bytes of a text that is read: of a scene or study file, and of a list of pixels.
inline constexpr std::size_t kMaxTomlBytes = std::size_t{8} << 20, kMaxPixelListBytes = std::size_t{256} << 20;

// The bytes of the file, which may be a pipe. Throws Error with Exit::io, naming the path and the reason, also for more
// than `max` bytes: an end to what never ends, such as /dev/zero.
std::string read_bytes(const std::string& path, std::size_t max);

// Throws as above for what is there and no regular file: of a pipe that a file names, nobody may hold the other end.
void require_regular_file(const std::string& path);

// Both: of a file that a file names.
std::string read_named_file(const std::string& path, std::size_t max);

}  // namespace moire
