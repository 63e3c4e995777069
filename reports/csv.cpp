// Tables as CSV.
#include "reports/csv.h"

#include <cmath>
#include <unordered_map>

#include "core/args.h"

namespace moire {
namespace {

std::string csv_text(const std::string& text) {
  if (!text.empty() && text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string field = "\"";
  for (const char c : text) {
    if (c == '"') field += '"';
    field += c;
  }
  return field + '"';
}

struct ToField {
  std::string operator()(std::monostate) const { return {}; }
  std::string operator()(bool value) const { return value ? "true" : "false"; }
  std::string operator()(std::int64_t value) const { return std::to_string(value); }
  std::string operator()(double value) const { return std::isfinite(value) ? shortest(value) : std::string(); }
  std::string operator()(const std::string& value) const { return csv_text(value); }
};

void add_line(const std::vector<std::string>& fields, std::string& text) {
  for (std::size_t i = 0; i < fields.size(); ++i) {
    if (i > 0) text += ',';
    text += fields[i];
  }
  text += '\n';
}

}  // namespace

std::string csv(const Table& table) {
  std::vector<std::string> header;
  std::unordered_map<std::string, std::size_t> column;
  for (const Row& row : table) {
    for (const auto& [name, cell] : row.cells()) {
      if (column.try_emplace(name, header.size()).second) header.push_back(csv_text(name));
    }
  }
  if (header.empty()) return {};
  std::string text;
  add_line(header, text);
  for (const Row& row : table) {
    std::vector<std::string> fields(header.size());
    for (const auto& [name, cell] : row.cells()) fields[column.at(name)] = std::visit(ToField{}, cell);
    add_line(fields, text);
  }
  return text;
}

}  // namespace moire
