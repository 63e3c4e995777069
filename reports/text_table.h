// A table of short texts for a terminal: columns lined up, the best of each column marked.
#pragma once

#include <string>
#include <vector>

namespace moire {

// One cell of such a table.
struct TextEntry {
  std::string text;  // UTF-8, no line ends
  double value = 0;  // competes for the smallest in its column; NaN: does not
};

// Line by line, the first line the header; all of the same length, at least one entry.
using TextLines = std::vector<std::vector<TextEntry>>;

// Indented by two blanks, the first column flush left and all others flush right, line ends included. The smallest
// value of each column but the first has a `*` after it (each of several equal ones), and is bold with `bold` (ANSI,
// for terminals only).
std::string text_table(const TextLines& lines, bool bold);

// Lines longer than `width` bytes broken at blanks; a word that is longer stays whole. Each line gets its line end.
std::string wrapped(const std::string& text, std::size_t width);

}  // namespace moire
