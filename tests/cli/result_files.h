// What a run wrote, for comparison with another run of the same study.
#pragma once

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "program.h"
#include "reports/page_reading.h"

namespace moire::cli {

// File name to bytes, times removed: each time_* value of JSON and of CSV becomes T, and of a page there is the data
// without what comes of times.
inline std::map<std::string, std::string> files_of(const std::filesystem::path& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (!entry.is_regular_file()) continue;
    const std::string name = std::filesystem::relative(entry.path(), folder).string();
    std::string text = read_file(entry.path());
    if (name == "results.jsonl") {
      std::string cleaned;
      for (const std::string& line : lines_of(text)) {
        auto row = nlohmann::ordered_json::parse(line);
        for (auto& [key, value] : row.items()) {
          if (key.starts_with("time_")) value = "T";
        }
        cleaned += row.dump() + "\n";
      }
      text = cleaned;
    } else if (name == "results.csv") {
      std::vector<bool> is_time;
      std::string cleaned;
      for (const std::string& line : lines_of(text)) {
        std::istringstream stream(line);
        std::size_t column = 0;
        for (std::string field; std::getline(stream, field, ','); ++column) {
          // The one field with commas is the filter, in quotes, left of all times.
          if (field.starts_with("\"")) {
            std::string rest;
            std::getline(stream, rest, '"');
            field += "," + rest + "\"";
            std::getline(stream, rest, ',');
          }
          if (cleaned.find('\n') == std::string::npos) is_time.push_back(field.starts_with("time_"));
          cleaned += (is_time.at(column) && cleaned.find('\n') != std::string::npos ? "T" : field) + ",";
        }
        cleaned += "\n";
      }
      text = cleaned;
    }
    if (name == "index.html") text = page::without_times(page::data_of(text));
    files[name] = text;
  }
  return files;
}

}  // namespace moire::cli
