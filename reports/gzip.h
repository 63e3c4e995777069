// gzip (P. Deutsch, RFC 1952, 1996) and base64 (S. Josefsson, RFC 4648, 2006): bytes of a page as text.
#pragma once

#include <string>
#include <string_view>

namespace moire {

// A gzip stream with no name and no time in its header: the same bytes give the same stream with the same zlib. Level
// 6: 9 takes six times as long on error images, for streams 2% smaller. Throws std::bad_alloc.
std::string gzip(std::string_view bytes);

// With padding, on one line.
std::string base64(std::string_view bytes);

}  // namespace moire
