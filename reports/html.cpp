// The report page.
#include "reports/html.h"

#include <cassert>

#ifndef MOIRE_NO_PAGE
#define MOIRE_NO_PAGE ""
#endif

namespace moire {
namespace {

constexpr std::string_view kNoPage = MOIRE_NO_PAGE;

constexpr unsigned char kTemplate[] = {
#ifdef MOIRE_HAS_PAGE
#include "report_template.inc"
#endif
    0};

// The marks stand in the template once each; build.mjs sees to that.
constexpr std::string_view kDataMark = "@MOIRE_REPORT_DATA@", kTitleMark = "@MOIRE_TITLE@";

std::string_view page_template() { return {reinterpret_cast<const char*>(kTemplate), sizeof kTemplate - 1}; }

}  // namespace

std::string_view why_no_page() { return kNoPage; }

std::size_t empty_page_bytes() {
  return kNoPage.empty() ? page_template().size() - kDataMark.size() - kTitleMark.size() : 0;
}

std::string html_text(std::string_view text) {
  std::string escaped;
  for (const char c : text) {
    switch (c) {
      case '&':
        escaped += "&amp;";
        break;
      case '<':
        escaped += "&lt;";
        break;
      case '>':
        escaped += "&gt;";
        break;
      case '"':
        escaped += "&quot;";
        break;
      default:
        escaped += c;
    }
  }
  return escaped;
}

std::string html_page(std::string_view title, std::string_view json) {
  const std::string_view page = page_template();
  const std::size_t title_at = page.find(kTitleMark), data_at = page.find(kDataMark);
  assert(title_at < data_at && data_at != std::string_view::npos && json.find('<') == std::string_view::npos);
  std::string html;
  html.reserve(page.size() + title.size() + json.size());
  html += page.substr(0, title_at);
  html += html_text(title);
  html += page.substr(title_at + kTitleMark.size(), data_at - title_at - kTitleMark.size());
  html += json;
  html += page.substr(data_at + kDataMark.size());
  return html;
}

}  // namespace moire
