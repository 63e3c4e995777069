// Results as JSON Lines. The one file that knows nlohmann-json.
#include "reports/json.h"

#include <cerrno>
#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>

#include "core/args.h"
#include "core/error.h"
#include "reports/file.h"

namespace moire {
namespace {

std::string json_text(std::string_view text) {
  return nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

// Numbers are written here and not by the library: its doubles always read back, but are not always the shortest.
struct ToJson {
  std::string operator()(std::monostate) const { return "null"; }
  std::string operator()(bool value) const { return value ? "true" : "false"; }
  std::string operator()(std::int64_t value) const { return std::to_string(value); }
  std::string operator()(double value) const {
    if (!std::isfinite(value)) return "null";
    std::string text = shortest(value);
    if (text.find_first_of(".e") == std::string::npos) text += ".0";  // or it would read back as an integer
    return text;
  }
  std::string operator()(const std::string& value) const { return json_text(value); }
};

}  // namespace

std::string json_header(const Tool& tool, const Host& host, const StudyText& study) {
  nlohmann::ordered_json line;
  line["kind"] = "header";
  line["schema"] = "moire.results/1";
  line["tool"] = {{"version", tool.version},   {"commit", tool.commit}, {"build_type", tool.build_type},
                  {"compiler", tool.compiler}, {"flags", tool.flags},   {"fp_contract", tool.fp_contract}};
  line["host"] = {{"cpu", host.cpu}, {"cores", host.cores}, {"os", host.os}};
  line["study"] = {{"name", study.name}, {"sha256", sha256(study.text)}, {"text", study.text}};
  return line.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

std::string json_row(const Row& row, std::string_view kind) {
  std::string line = "{";
  if (!kind.empty()) line += "\"kind\":" + json_text(kind);
  for (const auto& [name, cell] : row.cells()) {
    if (line.size() > 1) line += ',';
    line += json_text(name) + ":" + std::visit(ToJson{}, cell);
  }
  return line + "}";
}

Row parse_json_row(std::string_view line, const std::string& place) {
  const auto object = nlohmann::ordered_json::parse(line, nullptr, false);
  if (!object.is_object()) throw Error(place, "is not a JSON object on one line");
  Row row;
  for (const auto& [name, value] : object.items()) {
    if (name == "kind") continue;
    if (value.is_null()) {
      row.set(name, {});
    } else if (value.is_boolean()) {
      row.set(name, value.get<bool>());
    } else if (value.is_number_float()) {
      row.set(name, value.get<double>());
    } else if (value.is_number_unsigned() && value.get<std::uint64_t>() > INT64_MAX) {
      throw Error(place, "\"" + name + "\" is an integer beyond 64 bits with sign");
    } else if (value.is_number_integer()) {
      row.set(name, value.get<std::int64_t>());
    } else if (value.is_string()) {
      row.set(name, value.get<std::string>());
    } else {
      throw Error(place, "\"" + name + "\" must be a number, text, true, false or null");
    }
  }
  return row;
}

JsonLines::JsonLines(std::string path, std::string header)
    : path_(std::move(path)), header_(std::move(header)), file_(std::fopen(path_.c_str(), "wb")) {
  if (!file_) throw Error(path_, std::string("cannot be written: ") + std::strerror(errno), Exit::io);
  put(header_);
}

void JsonLines::put(const std::string& line) {
  const std::string bytes = line + "\n";
  // Out of the buffer at once: rows count as kept when the program is stopped.
  if (std::fwrite(bytes.data(), 1, bytes.size(), file_.get()) != bytes.size() || std::fflush(file_.get()) != 0) {
    throw Error(path_, std::string("cannot be written: ") + std::strerror(errno), Exit::io);
  }
}

void JsonLines::append(const Row& row) { put(json_row(row)); }

void JsonLines::finish(const Table& rows) {
  std::string bytes = header_ + "\n";
  for (const Row& row : rows) bytes += json_row(row) + "\n";
  file_.reset();
  write_whole(path_, bytes);
}

}  // namespace moire
