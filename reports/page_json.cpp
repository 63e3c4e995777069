// Pieces of a page's JSON.
#include "reports/page_json.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <unordered_map>
#include <utility>
#include <vector>

#include "reports/gzip.h"
#include "reports/json.h"

namespace moire {

void JsonObject::add(std::string_view name, std::string_view json) {
  if (text_.size() > 1) text_ += ',';
  text_ += json_text(name);
  text_ += ':';
  text_ += json;
}

void JsonObject::add_text(std::string_view name, std::string_view text) { add(name, json_text(text)); }

std::string json_array(std::span<const std::string> items) {
  std::string text = "[";
  for (const std::string& item : items) {
    if (text.size() > 1) text += ',';
    text += item;
  }
  return text + "]";
}

std::string drawn_numbers(std::span<const double> values, int digits) {
  std::string text = "[";
  for (const double value : values) {
    if (text.size() > 1) text += ',';
    if (std::isfinite(value)) {
      fmt::format_to(std::back_inserter(text), "{:.{}g}", value + 0.0, digits);  // no -0
    } else {
      text += "null";
    }
  }
  return text + "]";
}

std::string columns_json(const Table& table) {
  std::vector<std::pair<std::string, std::vector<std::string>>> columns;
  std::unordered_map<std::string, std::size_t> index;
  for (std::size_t i = 0; i < table.size(); ++i) {
    for (const auto& [name, cell] : table[i].cells()) {
      const auto [at, is_new] = index.try_emplace(name, columns.size());
      if (is_new) columns.emplace_back(name, std::vector<std::string>(table.size(), "null"));
      columns[at->second].second[i] = json_cell(cell);
    }
  }
  JsonObject object;
  for (const auto& [name, cells] : columns) {
    const bool constant = std::equal(cells.begin() + 1, cells.end(), cells.begin());
    object.add(name, constant ? "{\"all\":" + cells.front() + "}" : json_array(cells));
  }
  return "{\"length\":" + std::to_string(table.size()) + ",\"columns\":" + std::move(object).text() + "}";
}

std::string script_safe(std::string_view json) {
  std::string safe;
  safe.reserve(json.size());
  for (const char c : json) {
    if (c == '<') {
      safe += "\\u003c";
    } else {
      safe += c;
    }
  }
  return safe;
}

std::string packed_json(std::string json) {
  // The framing of gzip and base64 alone takes some 40 bytes.
  constexpr std::size_t kWorthIt = 256;
  if (json.size() < kWorthIt) return json;
  std::string packed = "{\"gz\":\"" + base64(gzip(json)) + "\"}";
  return packed.size() < json.size() ? packed : json;
}

}  // namespace moire
