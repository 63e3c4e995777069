// A table of short texts for a terminal.
#include "reports/text_table.h"

#include <algorithm>
#include <cmath>

namespace moire {
namespace {

// Code points, which is columns for the names that occur.
std::size_t columns_of(const std::string& text) {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xc0) != 0x80; }));
}

}  // namespace

std::string text_table(const TextLines& lines, bool bold) {
  const std::size_t columns = lines.front().size();
  std::vector<std::size_t> widths(columns, 0);
  std::vector<double> best(columns, std::nan(""));
  for (const auto& line : lines) {
    for (std::size_t i = 0; i < columns; ++i) {
      widths[i] = std::max(widths[i], columns_of(line[i].text) + 1);
      best[i] = std::fmin(best[i], line[i].value);
    }
  }
  std::string text;
  for (const auto& line : lines) {
    std::string out = line[0].text + std::string(widths[0] - columns_of(line[0].text), ' ');
    for (std::size_t i = 1; i < columns; ++i) {
      const bool is_best = line[i].value == best[i];
      out += std::string(widths[i] - columns_of(line[i].text), ' ');
      out += is_best && bold ? "\x1b[1m" + line[i].text + "*\x1b[0m" : line[i].text + (is_best ? "*" : " ");
    }
    out.erase(out.find_last_not_of(' ') + 1);
    text += "  " + out + "\n";
  }
  return text;
}

std::string wrapped(const std::string& text, std::size_t width) {
  std::string out;
  for (std::size_t begin = 0; begin < text.size();) {
    std::size_t end = std::min(text.find('\n', begin), text.size());
    if (end - begin > width) {
      const std::size_t blank = text.rfind(' ', begin + width);
      end = blank != std::string::npos && blank > begin ? blank : std::min(text.find(' ', begin), end);
    }
    out += text.substr(begin, end - begin) + "\n";
    begin = end + 1;
  }
  return out;
}

}  // namespace moire
