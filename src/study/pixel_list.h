// A list of pixels as text: lines x,y.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/geometry.h"

namespace moire {

// Lines x,y, any 64-bit integers, also outside of an image; lines may end in CR LF, and the last one need not end.
// `file` is what messages call the text. Throws Error with file:line:column at the first line that is none.
std::vector<Pixel> parse_pixels(std::string_view text, const std::string& file);

}  // namespace moire
