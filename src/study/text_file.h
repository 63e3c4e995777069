// Reading a whole text file.
#pragma once

#include <string>

namespace moire {

// The bytes of the file. Throws Error with Exit::io, naming the path and the reason; files above 256 MiB are refused.
std::string read_text(const std::string& path);

}  // namespace moire
