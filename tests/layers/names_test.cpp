// One name, one type. All rooms share a namespace, and two types of one name in two headers need not meet in any file
// to be a fault: the linker keeps one of their constructors, and a build without inlining crashes.
#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <string_view>

namespace fs = std::filesystem;

namespace {

// The name of the type that a line begins to define, such as `struct Name {` or `class Name : public Base {`; "" for
// other lines, declarations among them.
std::string defined_type(std::string_view line) {
  for (const std::string_view word : {"enum class ", "class ", "struct "}) {
    if (!line.starts_with(word)) continue;
    line.remove_prefix(word.size());
    const std::size_t end = line.find_first_of(" :;<{");
    return line.find('{') == std::string_view::npos ? "" : std::string(line.substr(0, end));
  }
  return "";
}

// Adds "name -> file" for each type that begins a line of the header; returns the names that were there already, with
// both files.
std::string add_types(const std::string& text, const std::string& file, std::map<std::string, std::string>& types) {
  std::istringstream lines(text);
  std::string twice;
  for (std::string line; std::getline(lines, line);) {
    const std::string name = defined_type(line);
    if (name.empty()) continue;
    const auto [at, added] = types.emplace(name, file);
    if (!added) twice += name + ": " + at->second + ", " + file + "\n";
  }
  return twice;
}

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("no two headers of the product define a type of the same name") {
    const fs::path root(MOIRE_SOURCE_DIR);
    std::map<std::string, std::string> types;
    std::string twice;
    for (const char* room : {"src", "filters", "testimages", "reports"}) {
      for (const fs::directory_entry& entry : fs::recursive_directory_iterator(root / room)) {
        if (entry.path().extension() != ".h") continue;
        // The oracle sees the same scenes and kernels in its own way: its types are in a namespace of their own.
        if (entry.path().parent_path().filename() == "oracle") continue;
        std::ostringstream text;
        text << std::ifstream(entry.path()).rdbuf();
        twice += add_types(text.str(), fs::relative(entry.path(), root).string(), types);
      }
    }
    CHECK(twice == "");
    CHECK(types.size() > 50);  // it does find them
  }

  TEST_CASE("a second type of a name is found, a declaration is not one") {
    std::map<std::string, std::string> types;
    CHECK(add_types("class Kernel {\n};\nstruct Other;\n", "a.h", types).empty());
    CHECK(add_types("class Kernel;\nstruct Other {\n", "b.h", types).empty());
    CHECK(add_types("struct Kernel : Base {\n", "c.h", types) == "Kernel: a.h, c.h\n");
  }
}
