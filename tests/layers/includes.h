// Which include may stand where: the layers of the house and the one door of each third party (HACKING.md, "Layers").
// Reads the sources as text; no compiler is asked.
#pragma once

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace moire::layers {

// A folder of the product. Rooms of one layer do not know each other.
struct Room {
  std::string_view folder;
  int layer;
};
inline constexpr Room kRooms[] = {
    {"src/core", 0},    {"src/curve", 1},  {"src/patterns", 2}, {"filters", 2},    {"testimages", 2}, {"src/engine", 3},
    {"src/measure", 3}, {"src/oracle", 3}, {"src/study", 4},    {"src/stress", 4}, {"reports", 5},    {"src/app", 6},
};

// A third-party header <prefix...> may be included only by source files whose path starts with one of `places`
// (separated by blanks; "*" is any), and never by a header.
struct Door {
  std::string_view prefix, places;
};
inline constexpr Door kDoors[] = {
    {"toml++/", "src/study/document.cpp"},
    {"CLI/", "src/app/"},
    {"OpenImageIO/", "reports/exr.cpp reports/png.cpp"},
    {"nlohmann/", "reports/json.cpp"},
    {"tbb/", "src/core/parallel.cpp"},
    {"oneapi/", "src/core/parallel.cpp"},
    {"openssl/", "reports/provenance.cpp"},
    {"zlib.h", "reports/gzip.cpp"},
    {"Eigen/", "testimages/homography.cpp"},
    {"opencv2/", "src/measure/dft.cpp"},
    {"arb", "src/stress/"},
    {"fmt/", "*"},
};

// One include directive: the name between quotes or angle brackets, and which of the two.
struct Include {
  std::string name;
  bool quoted = false;
};

// The include directive of a line, if it is one. Lines that only mention one, in a comment, are not.
inline std::optional<Include> parse_include(std::string_view line) {
  const auto skip_blanks = [&line] { line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size())); };
  const auto take = [&line](std::string_view word) {
    if (!line.starts_with(word)) return false;
    line.remove_prefix(word.size());
    return true;
  };
  skip_blanks();
  if (!take("#")) return std::nullopt;
  skip_blanks();
  if (!take("include")) return std::nullopt;
  skip_blanks();
  const bool quoted = line.starts_with('"');
  if (!quoted && !line.starts_with('<')) return std::nullopt;
  line.remove_prefix(1);
  const std::size_t end = line.find(quoted ? '"' : '>');
  if (end == std::string_view::npos) return std::nullopt;
  return Include{std::string(line.substr(0, end)), quoted};
}

// The room that holds a path relative to the root; null when none does.
inline const Room* room_of(const std::string& path) {
  for (const Room& room : kRooms)
    if (path.starts_with(std::string(room.folder) + "/")) return &room;
  return nullptr;
}

// What is wrong with `include` in `file` (both relative to `root`); empty when it is allowed.
inline std::string fault(const std::filesystem::path& root, const std::string& file, const Include& include) {
  namespace fs = std::filesystem;
  const Room& here = *room_of(file);
  const bool header = fs::path(file).extension() == ".h";

  if (!include.quoted) {
    for (const Door& door : kDoors) {
      if (!include.name.starts_with(door.prefix)) continue;
      if (header) return "a third party in a header";
      for (std::string_view places = door.places; !places.empty();) {
        const std::string_view place = places.substr(0, places.find(' '));
        if (place == "*" || file.starts_with(place)) return {};
        places.remove_prefix(std::min(place.size() + 1, places.size()));
      }
      return "the door of this third party is " + std::string(door.places);
    }
    // The standard library has no folders; <sys/...> is POSIX.
    const bool known = include.name.find('/') == std::string::npos || include.name.starts_with("sys/");
    return known ? "" : "a third party without a door, or a file of ours in angle brackets";
  }

  // Lists that CMake writes, only for the room's own files: those of moire_plugins(), and others that the room's
  // CMakeLists.txt names.
  if (include.name == fs::path(here.folder).filename().string() + "_plugins.inc") return {};
  if (include.name.ends_with(".inc") && include.name.find('/') == std::string::npos) {
    std::ifstream list(root / here.folder / "CMakeLists.txt");
    const std::string text(std::istreambuf_iterator<char>(list), {});
    if (text.find("generated/" + include.name) != std::string::npos) return {};
  }
  for (const fs::path& base : {fs::path(file).parent_path(), fs::path(), fs::path("src")}) {
    const std::string target = (base / include.name).lexically_normal().generic_string();
    // CMake writes some headers from a template that stands where the header would.
    if (!fs::is_regular_file(root / target) && !fs::is_regular_file(root / (target + ".in"))) continue;
    const Room* there = room_of(target);
    if (there == nullptr) return target + " is in no room of the product";
    if (there == &here || there->layer < here.layer) return {};
    return "layer " + std::to_string(here.layer) + " may not know " + std::string(there->folder) + " (layer " +
           std::to_string(there->layer) + ")";
  }
  return "there is no such file";
}

// All forbidden includes below `root`, as "file:line: what", sorted. `files` is set to the number of files read.
inline std::vector<std::string> violations(const std::filesystem::path& root, int& files) {
  namespace fs = std::filesystem;
  std::vector<std::string> found;
  files = 0;
  for (const Room& room : kRooms) {
    if (!fs::is_directory(root / room.folder)) continue;
    for (const auto& entry : fs::recursive_directory_iterator(root / room.folder)) {
      const fs::path extension = entry.path().extension();
      if (extension != ".h" && extension != ".cpp" && extension != ".inc") continue;
      ++files;
      const std::string file = entry.path().lexically_relative(root).generic_string();
      std::ifstream in(entry.path());
      int number = 0;
      for (std::string line; std::getline(in, line);) {
        ++number;
        const auto include = parse_include(line);
        if (!include) continue;
        const std::string what = fault(root, file, *include);
        if (!what.empty()) found.push_back(file + ":" + std::to_string(number) + ": " + include->name + ": " + what);
      }
    }
  }
  std::sort(found.begin(), found.end());
  return found;
}

}  // namespace moire::layers
