// Tables in GitHub's Markdown.
#include "reports/markdown_table.h"

namespace moire {

std::string markdown_code(std::string_view name) {
  std::string out = "`";
  for (const char c : name) {
    if (c == '|') out += '\\';
    out += c;
  }
  return out + "`";
}

std::string markdown_table(const std::vector<std::vector<std::string>>& lines) {
  std::string out;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    out += "|";
    for (const std::string& cell : lines[i]) out += " " + cell + " |";
    out += "\n";
    if (i > 0) continue;
    out += "|";
    for (std::size_t column = 0; column < lines[0].size(); ++column) out += ":--|";
    out += "\n";
  }
  return out + "\n";
}

}  // namespace moire
