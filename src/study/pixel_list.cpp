// A list of pixels as text: lines x,y.
#include "study/pixel_list.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstdint>

#include "core/error.h"

namespace moire {
namespace {

// One whole number from the front of `text`; what follows is left.
bool take_integer(std::string_view& text, std::int64_t& out) {
  const char* begin = text.data();
  const auto [end, status] = std::from_chars(begin, begin + text.size(), out);
  text.remove_prefix(static_cast<std::size_t>(end - begin));
  return status == std::errc();
}

Pixel parse_pixel(std::string_view line, const std::string& file, std::size_t number) {
  const std::string_view whole = line;
  if (line.ends_with('\r')) line.remove_suffix(1);
  Pixel pixel;
  const bool x = take_integer(line, pixel.x);
  const bool comma = x && line.starts_with(',');
  if (comma) line.remove_prefix(1);
  if (comma && take_integer(line, pixel.y) && line.empty()) return pixel;
  const auto column = static_cast<std::size_t>(line.data() - whole.data()) + 1;
  throw Error(fmt::format("{}:{}:{}", file, number, column),
              fmt::format("\"{}\" is no pixel; write x,y, two whole numbers of 64 bits", whole.substr(0, 60)));
}

}  // namespace

std::vector<Pixel> parse_pixels(std::string_view text, const std::string& file) {
  std::vector<Pixel> pixels;
  for (std::size_t number = 1; !text.empty(); ++number) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    pixels.push_back(parse_pixel(text.substr(0, end), file, number));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return pixels;
}

}  // namespace moire
