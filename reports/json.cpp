// Results as JSON Lines. The one file that knows nlohmann-json.
#include "reports/json.h"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <system_error>

#include "core/args.h"
#include "core/error.h"
#include "reports/file.h"
#include "study/text_file.h"

namespace moire {
namespace {

// Of a results file: a million rows of a few kB each.
constexpr std::uintmax_t kMaxResultsBytes = std::uintmax_t{8} << 30;
// Of one with several tables: a few kB a case.
constexpr std::size_t kMaxTablesBytes = std::size_t{512} << 20;

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

Error not_regular(const std::string& path) { return Error(path, "is no regular file; give another folder", Exit::io); }

Row row_of(const nlohmann::ordered_json& object, const std::string& place) {
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

// The text at a JSON pointer, "" when there is none.
std::string text_of(const nlohmann::ordered_json& object, const char* path) {
  const nlohmann::ordered_json::json_pointer pointer(path);
  return object.contains(pointer) && object[pointer].is_string() ? object[pointer].get<std::string>() : std::string();
}

}  // namespace

std::string json_header(const Tool& tool, const Host& host, const StudyText& study, std::string_view schema) {
  nlohmann::ordered_json line;
  line["kind"] = "header";
  line["schema"] = schema;
  line["tool"] = {{"version", tool.version},   {"commit", tool.commit}, {"build_type", tool.build_type},
                  {"compiler", tool.compiler}, {"flags", tool.flags},   {"fp_contract", tool.fp_contract}};
  line["host"] = {{"cpu", host.cpu}, {"cores", host.cores}, {"os", host.os}};
  line["study"] = {{"name", study.name}, {"sha256", sha256(study.text)}, {"text", study.text}};
  return line.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

std::string json_text(std::string_view text) {
  return nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

std::string json_cell(const Cell& cell) { return std::visit(ToJson{}, cell); }

std::string text_at(std::string_view object, const char* pointer) {
  return text_of(nlohmann::ordered_json::parse(object, nullptr, false), pointer);
}

void check_header(std::string_view header, const std::string& place) {
  const auto object = nlohmann::ordered_json::parse(header, nullptr, false);
  if (!object.is_object()) throw Error(place, "is not the header of results");
  constexpr const char* kTexts[] = {"/study/name",  "/study/text",      "/study/sha256",  "/tool/version",
                                    "/tool/commit", "/tool/build_type", "/tool/compiler", "/tool/flags",
                                    "/host/cpu",    "/host/os"};
  const auto lacks = [&](std::string path, const char* type) {
    std::replace(path.begin(), path.end(), '/', '.');
    return Error(place, "the header lacks \"" + path.substr(1) + "\", " + type);
  };
  for (const char* path : kTexts) {
    const nlohmann::ordered_json::json_pointer pointer(path);
    if (!object.contains(pointer) || !object[pointer].is_string()) throw lacks(path, "a text");
  }
  const nlohmann::ordered_json::json_pointer cores("/host/cores");
  if (!object.contains(cores) || !object[cores].is_number_integer()) throw lacks("/host/cores", "an integer");
}

std::string json_row(const Row& row, std::string_view kind) {
  std::string line = "{";
  if (!kind.empty()) line += "\"kind\":" + json_text(kind);
  for (const auto& [name, cell] : row.cells()) {
    if (line.size() > 1) line += ',';
    line += json_text(name) + ":" + json_cell(cell);
  }
  return line + "}";
}

std::string json_lines(const std::string& header, std::initializer_list<JsonTable> tables) {
  std::string text = header + "\n";
  for (const JsonTable& table : tables) {
    for (const Row& row : *table.rows) text += json_row(row, table.kind) + "\n";
  }
  return text;
}

std::string json_object(const std::string& header, std::initializer_list<JsonTable> tables) {
  std::string text = "{\"header\":" + header;
  for (const JsonTable& table : tables) {
    text += ",\n\"" + std::string(table.name) + "\":[";
    for (const Row& row : *table.rows) text += (&row == table.rows->data() ? "" : ",\n ") + json_row(row, "");
    text += "]";
  }
  return text + "}\n";
}

Row parse_json_row(std::string_view line, const std::string& place) {
  return row_of(nlohmann::ordered_json::parse(line, nullptr, false), place);
}

Table parse_json_rows(std::string_view array, const std::string& place) {
  const auto items = nlohmann::ordered_json::parse(array, nullptr, false);
  if (!items.is_array()) throw Error(place, "is not a JSON array");
  Table rows;
  for (const auto& item : items) rows.push_back(row_of(item, place));
  return rows;
}

ResultsFile read_results(const std::string& path) {
  ResultsFile found;
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status)) return found;
  if (!std::filesystem::is_regular_file(status)) throw not_regular(path);
  if (std::filesystem::file_size(path, error) > kMaxResultsBytes) {
    throw Error(path, "is above 8 GiB, more than the rows of any study", Exit::io);
  }
  std::ifstream file(path, std::ios::binary);
  const auto check = [&] {
    if (!file.eof() && file.fail()) {
      throw Error(path, std::string("cannot be read: ") + std::strerror(errno == 0 ? EIO : errno), Exit::io);
    }
  };
  errno = 0;
  check();
  std::string line;
  for (std::size_t number = 1; std::getline(file, line); ++number) {
    const std::string place = path + ":" + std::to_string(number);
    const bool has_end = !file.eof(), is_last = !has_end || file.peek() == std::ifstream::traits_type::eof();
    const auto object = nlohmann::ordered_json::parse(line, nullptr, false);
    if (is_last && (!has_end || !object.is_object())) {
      found.cut = line;
      break;
    }
    if (text_of(object, "/kind") != (number == 1 ? "header" : "row")) {
      throw Error(place, number == 1 ? "is not the header of results" : "is not a row of results; mend or remove it");
    }
    if (number == 1) {
      found.header = line;
    } else {
      found.rows.push_back(row_of(object, place));
    }
    found.whole_bytes += line.size() + 1;
  }
  check();
  return found;
}

JsonTables read_json_tables(const std::string& path) {
  JsonTables found;
  std::istringstream lines(read_bytes(path, kMaxTablesBytes));
  std::string line;
  for (std::size_t number = 1; std::getline(lines, line); ++number) {
    const std::string place = path + ":" + std::to_string(number);
    const auto object = nlohmann::ordered_json::parse(line, nullptr, false);
    const std::string kind = text_of(object, "/kind");
    if ((number == 1) != (kind == "header") || kind.empty()) {
      throw Error(place, number == 1 ? "is not the header of results" : "is not a row of results; mend or remove it");
    }
    if (number == 1) {
      found.header = line;
      continue;
    }
    auto at = std::find_if(found.tables.begin(), found.tables.end(), [&](const auto& t) { return t.first == kind; });
    if (at == found.tables.end()) at = found.tables.insert(at, {kind, {}});
    at->second.push_back(row_of(object, place));
  }
  return found;
}

std::string header_difference(const std::string& found, const std::string& expected) {
  const auto a = nlohmann::ordered_json::parse(found, nullptr, false);
  const auto b = nlohmann::ordered_json::parse(expected, nullptr, false);
  struct Part {
    const char *what, *path;
  };
  constexpr Part kParts[] = {
      {"schema", "/schema"},       {"study", "/study/sha256"}, {"name of the study", "/study/name"},
      {"build", "/tool/version"},  {"build", "/tool/commit"},  {"build", "/tool/build_type"},
      {"build", "/tool/compiler"}, {"build", "/tool/flags"},   {"build", "/tool/fp_contract"}};
  for (const Part& part : kParts) {
    const std::string there = text_of(a, part.path), here = text_of(b, part.path);
    if (there == here) continue;
    const std::string_view field = std::string_view(part.path).substr(std::string_view(part.path).rfind('/') + 1);
    return std::string("another ") + part.what + " (" + std::string(field) + " \"" + there + "\", here \"" + here +
           "\")";
  }
  return {};
}

JsonLines::JsonLines(std::string path, std::string header) : path_(std::move(path)), header_(std::move(header)) {
  std::error_code error;  // what cannot be asked about is no pipe; opening it will say what is wrong
  if (std::filesystem::is_fifo(path_, error)) throw not_regular(path_);  // it would wait for somebody who reads
  file_.reset(std::fopen(path_.c_str(), "wb"));
  if (!file_) throw Error(path_, std::string("cannot be written: ") + std::strerror(errno), Exit::io);
  put(header_);
}

JsonLines::JsonLines(std::string path, const ResultsFile& found) : path_(std::move(path)), header_(found.header) {
  std::error_code error;
  std::filesystem::resize_file(path_, found.whole_bytes, error);
  if (error) throw Error(path_, "cannot be written: " + error.message(), Exit::io);
  file_.reset(std::fopen(path_.c_str(), "ab"));
  if (!file_) throw Error(path_, std::string("cannot be written: ") + std::strerror(errno), Exit::io);
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
