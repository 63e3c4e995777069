// The report page: one HTML file with its script, its style and its data. The template comes from reports/web and is
// part of the program, unless node was missing when that was built.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace moire {

// "" when the program has the page; else why not, as in "the program was built without node and npm".
std::string_view why_no_page();

// Bytes of the page without data and title; 0 when there is none.
std::size_t empty_page_bytes();

// The page. `title` is any text; `json` (page_data.h) has no '<', so that nothing in it ends the element that holds it.
// Precondition: why_no_page() is "".
std::string html_page(std::string_view title, std::string_view json);

// Text within an element or a quoted attribute.
std::string html_text(std::string_view text);

}  // namespace moire
