// Tables in GitHub's Markdown.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace moire {

// A name in a table cell.
std::string markdown_code(std::string_view name);

// Lines of equal length, the first one the header; a blank line ends the table.
std::string markdown_table(const std::vector<std::vector<std::string>>& lines);

}  // namespace moire
