// The table of filters as text, and the plain tables that it shares with the answer on the terminal.
#include "reports/filter_table.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "reports/text_table.h"
#include "study/filter_table.h"

namespace moire {
namespace {

const double kNan = std::nan("");

TEST_SUITE("io") {
  TEST_CASE("a text table lines columns up by characters and marks the best of each") {
    const TextLines lines = {{{"name", kNan}, {"a", kNan}, {"bb", kNan}},
                             {{"\xc3\xa9t\xc3\xa9", kNan}, {"1.5", 1.5}, {"20", 20}},
                             {{"x", kNan}, {"-3", -3}, {"20", 20}},
                             {{"longest", kNan}, {"-", kNan}, {"300", 300}}};
    CHECK(text_table(lines, false) ==
          "  name       a   bb\n"
          "  \xc3\xa9t\xc3\xa9      1.5   20*\n"
          "  x         -3*  20*\n"
          "  longest    -  300\n");
    const std::string bold = text_table(lines, true);
    CHECK(bold.find("\x1b[1m-3*\x1b[0m") != std::string::npos);
    CHECK(text_table({{{"only", 1.0}}}, false) == "  only\n");
  }

  TEST_CASE("text is broken at blanks, and a word longer than a line stays whole") {
    CHECK(wrapped("one two three", 7) == "one two\nthree\n");
    CHECK(wrapped("one\ntwo", 80) == "one\ntwo\n");
    CHECK(wrapped("incomprehensible is long", 4) == "incomprehensible\nis\nlong\n");
    CHECK(wrapped("", 10).empty());
  }

  TEST_CASE("a radial filter has the same columns as a separable one, and their meanings say what is of the plane") {
    const auto lines = filter_cells(filter_table(std::vector<Filter>{Filter(parse_spec("disk", "test"))}));
    // Radius 1/2: integral pi / 4 before normalising, noise gain 4 / pi, variance R^2 / 4.
    const std::vector<std::string> wanted = {"disk", "0.5", "0.7854", "1", "0.0625"};
    REQUIRE(lines.size() == 2);
    for (std::size_t i = 0; i < wanted.size(); ++i) CHECK(lines[1][i] == wanted[i]);
    for (const std::string& cell : lines[1]) CHECK(cell != "-");
    for (const ColumnMeaning& column : filter_columns()) {
      const bool differs = column.head == "I" || column.head == "ripple" || column.head == "L1" || column.head == "E";
      if (differs) CHECK(column.meaning.find("radial") != std::string::npos);
    }
  }

  TEST_CASE("every column of the filters' table has a cell per filter and a meaning") {
    const std::vector<Filter> filters = {Filter(parse_spec("mitchell", "test")),
                                         Filter(parse_spec("gaussian:sigma=0.4", "test"))};
    const auto lines = filter_cells(filter_table(filters));
    const auto columns = filter_columns();
    REQUIRE(lines.size() == 3);
    for (const auto& line : lines) REQUIRE(line.size() == columns.size() + 1);
    CHECK(lines[0][0] == "filter");
    CHECK(lines[1][0] == "mitchell");
    CHECK(lines[2][0] == "gaussian:sigma=0.4");
    for (std::size_t i = 0; i < columns.size(); ++i) {
      CHECK(lines[0][i + 1] == columns[i].head);
      CHECK(!columns[i].meaning.empty());
      CHECK(lines[1][i + 1] != "-");
    }
    const std::string text = filter_text(filter_table(filters));
    for (const auto& column : columns) CHECK(text.find(column.meaning) != std::string::npos);
    CHECK(filter_text({}).empty());
  }

  TEST_CASE("numbers that round to zero have no sign, rounding is no ripple, and what is missing is a dash") {
    Row row;
    row.set("filter", std::string("f"));
    row.set("variance", -1e-17);
    row.set("ripple", 2.2e-16);
    row.set("integral", std::numeric_limits<double>::infinity());
    row.set("smoothing", -0.299);
    const auto lines = filter_cells({row});
    const auto cell = [&](const std::string& head) {
      for (std::size_t i = 0; i < lines[0].size(); ++i) {
        if (lines[0][i] == head) return lines[1][i];
      }
      return std::string("no such column");
    };
    CHECK(cell("var px^2") == "0.0000");
    CHECK(cell("ripple") == "0");
    CHECK(cell("I") == "-");
    CHECK(cell("S") == "-0.299");
    CHECK(cell("P") == "-");
  }
}

}  // namespace
}  // namespace moire
