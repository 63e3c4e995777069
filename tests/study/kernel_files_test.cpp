// Kernels of a study that stand in files of their own: where they are found, and that they belong to the study.
#include <doctest/doctest.h>

#include <string>

#include "message.h"
#include "study/study.h"
#include "test_folder.h"

using namespace moire;

TEST_SUITE("unit") {
  TEST_CASE("a kernel's file is found from the study's folder and its text belongs to the study's") {
    const test::TestFolder folder("kernel_files_test");
    folder.write("deep/kernels/mine.csv", "0,1\n1,0\n");
    const std::string file = folder.file("deep/study.toml");
    const std::string scene = "[[scene]]\nkind = \"edge\"\nwidth = 32\nheight = 16\nthrough = [16, 8]\nnormal = 30\n";
    const std::string text =
        "patterns = [\"random\"]\nfilters = [\"box\", \"tabulated:path=kernels/mine.csv\"]\n" + scene;
    const Study study = parse_study(text, file, "study");
    REQUIRE(study.filters.size() == 2);
    CHECK(study.filters[1].kernel().radius() == 1);
    // Rows are named by the text as written; where the study lies is no part of them.
    CHECK(study.filters[1].text() == "tabulated:path=kernels/mine.csv");
    CHECK(study.filters[1].args().text("path") == "kernels/mine.csv");
    CHECK(study.text.starts_with(text));
    CHECK(contains(study.text, "0,1\n1,0\n"));

    // Another kernel is another study, and what is wrong with it is said where it stands.
    folder.write("deep/kernels/mine.csv", "0,1\n1,0.5\n2,0\n");
    CHECK(parse_study(text, file, "study").text != study.text);
    folder.write("deep/kernels/mine.csv", "0,1\n1,one\n");
    CHECK(contains(message_of([&] { parse_study(text, file, "study"); }), "kernels/mine.csv:2:3: k is not a number"));
    const std::string missing = message_of([&] {
      parse_study("patterns = [\"random\"]\nfilters = [\"tabulated:path=none.csv\"]\n" + scene, file, "study");
    });
    CHECK(contains(missing, "study.toml:2:12"));
    CHECK(contains(missing, "none.csv"));
    const std::string comma = message_of([&] {
      parse_study("patterns = [\"random\"]\nfilters = [\"tabulated:path=a,b.csv\"]\n" + scene, file, "study");
    });
    CHECK(contains(comma, "cannot have a comma"));
    const std::string line_break = message_of([&] {
      parse_study("patterns = [\"random\"]\nfilters = [\"tabulated:path=a\\nb.csv\"]\n" + scene, file, "study");
    });
    CHECK(contains(line_break, "control character"));
  }
}
