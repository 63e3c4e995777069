// The layers of the house: every include of the product points down, and every planted fault is found.
#include <doctest/doctest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include "layers/includes.h"

namespace fs = std::filesystem;
using moire::layers::violations;

namespace {

// A small house in a folder of its own, removed at the end.
class PlantedTree {
 public:
  explicit PlantedTree(const std::vector<std::pair<std::string, std::string>>& files)
      : root_(fs::temp_directory_path() / ("moire_layers_" + std::to_string(::getpid()))) {
    fs::remove_all(root_);
    for (const auto& [path, text] : files) {
      fs::create_directories((root_ / path).parent_path());
      std::ofstream(root_ / path) << text;
    }
  }
  ~PlantedTree() {
    std::error_code ignored;
    fs::remove_all(root_, ignored);
  }
  PlantedTree(const PlantedTree&) = delete;
  PlantedTree& operator=(const PlantedTree&) = delete;

  std::vector<std::string> violations() const {
    int files = 0;
    return moire::layers::violations(root_, files);
  }

 private:
  fs::path root_;
};

// What is found when one file of the house says `text`.
std::vector<std::string> planted(const std::string& file, const std::string& text) {
  std::vector<std::pair<std::string, std::string>> files = {{"src/core/sum.h", "#pragma once\n"},
                                                            {"src/patterns/pattern.h", "#pragma once\n"},
                                                            {"src/engine/render.h", "#pragma once\n"},
                                                            {"filters/filter.h", "#pragma once\n"},
                                                            {"tests/scenes.h", "#pragma once\n"}};
  files.emplace_back(file, text);
  return PlantedTree(files).violations();
}

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("every include of the product points to a lower layer or stays in its room") {
    int files = 0;
    const std::vector<std::string> found = violations(MOIRE_SOURCE_DIR, files);
    CHECK(files > 30);  // the check has read the product, not an empty folder
    for (const std::string& violation : found) FAIL_CHECK(violation);
  }

  TEST_CASE("includes that point down or stay at home are allowed") {
    CHECK(planted("src/patterns/regular.cpp", "#include \"patterns/pattern.h\"\n").empty());
    CHECK(planted("src/patterns/regular.cpp", "#include \"pattern.h\"\n#include \"core/sum.h\"\n").empty());
    CHECK(planted("src/engine/render.cpp", "#include \"filters/filter.h\"\n#include <vector>\n").empty());
    CHECK(planted("src/patterns/pattern.cpp", "#include \"patterns_plugins.inc\"\n").empty());
    CHECK(planted("filters/box.cpp", "#include <fmt/format.h>\n").empty());
    CHECK(planted("src/core/parallel.cpp", "#include <tbb/parallel_for.h>\n").empty());
    CHECK(planted("src/core/sum.cpp", "// #include \"engine/render.h\" would be wrong here\n").empty());
  }

  TEST_CASE("a list that CMake writes is allowed where the room's CMakeLists.txt names it") {
    const auto tree = [](const char* list) {
      return PlantedTree({{"src/app/CMakeLists.txt", list}, {"src/app/studies.cpp", "#include \"studies.inc\"\n"}})
          .violations();
    };
    CHECK(tree("file(GENERATE OUTPUT ${here}/generated/studies.inc)\n").empty());
    CHECK(tree("# no such list\n").size() == 1);
  }

  TEST_CASE("planted faults are found with their file and line") {
    struct Fault {
      const char *file, *text, *what;
    };
    const Fault faults[] = {
        {"src/core/sum.cpp", "\n#include \"engine/render.h\"\n", "src/core/sum.cpp:2: engine/render.h: layer 0"},
        {"filters/box.cpp", "#include \"patterns/pattern.h\"\n", "may not know src/patterns"},     // same layer
        {"filters/box.cpp", "# include \"../src/patterns/pattern.h\"\n", "may not know src/pat"},  // by another way
        {"src/engine/render.cpp", "#include \"filters/fliter.h\"\n", "there is no such file"},
        {"src/engine/render.cpp", "#include \"tests/scenes.h\"\n", "is in no room"},
        {"src/engine/render.cpp", "#include \"patterns_plugins.inc\"\n", "there is no such file"},
        {"src/engine/render.cpp", "#include <filters/filter.h>\n", "angle brackets"},
        {"src/engine/render.cpp", "#include <tbb/parallel_for.h>\n", "the door of this third party"},
        {"reports/images.cpp", "#include <OpenImageIO/imageio.h>\n", "the door of this third party"},
        {"src/core/parallel.h", "#include <tbb/parallel_for.h>\n", "a third party in a header"},
        {"src/engine/render.cpp", "#include <boost/math/constants.hpp>\n", "a third party without a door"},
    };
    for (const Fault& fault : faults) {
      CAPTURE(fault.file);
      CAPTURE(fault.text);
      const std::vector<std::string> found = planted(fault.file, fault.text);
      REQUIRE(found.size() == 1);
      CHECK_MESSAGE(found[0].find(fault.what) != std::string::npos, found[0]);
    }
  }
}
