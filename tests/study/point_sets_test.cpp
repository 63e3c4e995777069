// Reading sets of points: what is a set, and what is refused where.
#include "study/point_sets.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include "message.h"
#include "test_folder.h"

using namespace moire;

namespace {

// Reads from a text, `step` bytes at a time.
std::vector<PointSet> parse(const std::string& text, std::size_t step = 1 << 16) {
  std::size_t at = 0;
  return parse_point_sets(
      [&](char* bytes, std::size_t size) {
        const std::size_t count = std::min({size, step, text.size() - at});
        std::memcpy(bytes, text.data() + at, count);
        at += count;
        return count;
      },
      "p.txt");
}

std::string refusal(const std::string& text) {
  return message_of([&] { parse(text); });
}

bool is_at(const std::string& message, const std::string& place) { return message.starts_with(place + ": "); }

using Numbers = std::vector<double>;

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("points come in the order of the text, with every digit, whatever stands between their coordinates") {
    for (const std::string text :
         {"0.25,0.5\n0.1,0.9999999999999999\n", "0.25 0.5\n0.1\t0.9999999999999999",
          " 0.25 , 0.5 \r\n0.1 ,\t0.9999999999999999\r\n", "\n\n2.5e-1  5E-1\n\n  \n1e-1,0.99999999999999990000\n\n"}) {
      CAPTURE(text);
      const std::vector<PointSet> sets = parse(text);
      REQUIRE(sets.size() == 1);
      CHECK(sets[0].x == Numbers{0.25, 0.1});
      CHECK(sets[0].y == Numbers{0.5, 0.9999999999999999});
      CHECK(sets[0].t.empty());
    }
    const std::vector<PointSet> timed = parse("0.5,0.25,0.125\n0,-0,1e-300\n");
    CHECK(timed[0].t == Numbers{0.125, 1e-300});
    CHECK(timed[0].y == Numbers{0.25, 0.0});
  }

  TEST_CASE("a line that begins with # ends a set, and none is ever empty") {
    const std::string a = "0.1,0.2\n0.3,0.4\n", b = "0.5,0.6\n";
    CHECK(parse(a + "#\n" + b).size() == 2);
    CHECK(parse("# of the first set\n" + a + "# next\n" + b).size() == 2);
    CHECK(parse("#\n#\n\n" + a + "#\n\n#\n# \n" + b + "#\n#\n").size() == 2);
    CHECK(parse("  # indented\n" + a).size() == 1);
    const std::vector<PointSet> sets = parse(a + "#\n" + b);
    CHECK(sets[0].x == Numbers{0.1, 0.3});  // sizes differ
    CHECK(sets[1].x == Numbers{0.5});
    CHECK(sets[1].y == Numbers{0.6});
  }

  TEST_CASE("each set may have a header, as moire points writes it") {
    for (const std::string header : {"x,y\n", "X, Y\r\n", "x y\n", "\nx\ty\n"}) {
      CAPTURE(header);
      const std::vector<PointSet> sets = parse(header + "0.1,0.2\n#\n" + header + "0.3,0.4\n#\n0.5,0.6\n");
      REQUIRE(sets.size() == 3);
      CHECK(sets[1].x == Numbers{0.3});
    }
    CHECK(parse("# a comment\nx,y,t\n0.1,0.2,0.3\n")[0].t == Numbers{0.3});
    // Elsewhere it is no point.
    CHECK(is_at(refusal("0.1,0.2\nx,y\n"), "p.txt:2:1"));
    CHECK(is_at(refusal("x,y\nx,y\n0.1,0.2\n"), "p.txt:2:1"));
    CHECK(is_at(refusal("y,x\n0.1,0.2\n"), "p.txt:1:1"));
    CHECK(is_at(refusal("x,y,t\n0.1,0.2\n"), "p.txt:2:5"));
  }

  TEST_CASE("a byte order mark at the beginning of the text is skipped, and is no text anywhere else") {
    const std::string mark = "\xEF\xBB\xBF";
    for (const std::string text : {"0.1,0.2\n", "x,y\n0.1,0.2\n", "# a set\n0.1,0.2", "\r\n0.1 0.2\r\n"}) {
      for (const std::size_t step : {std::size_t{1}, std::size_t{2}, std::size_t{1000}}) {
        REQUIRE(parse(mark + text, step).size() == 1);
        CHECK(parse(mark + text, step)[0].x == Numbers{0.1});
      }
    }
    CHECK(is_at(refusal("0.1,0.2\n" + mark + "0.1,0.2\n"), "p.txt:2:1"));
    CHECK(is_at(refusal(mark + mark + "0.1,0.2\n"), "p.txt:1:1"));
    CHECK(contains(refusal(mark), "has no points"));
  }

  TEST_CASE("what is no point of the unit square is refused with line and column") {
    for (const char* bad : {"1", "1.0", "-1e-9", "2", "nan", "-nan", "inf", "-inf", "0.99999999999999999999", "1e3"}) {
      CAPTURE(bad);
      const std::string number(bad);
      const std::string first = refusal("0.1,0.2\n" + number + ",0.5\n"),
                        second = refusal("0.1,0.2\n\n0.5,  " + number);
      CHECK(is_at(first, "p.txt:2:1"));
      CHECK(is_at(second, "p.txt:3:7"));
      CHECK(contains(first, "[0, 1)"));
      CHECK(is_at(refusal("0.1,0.2," + number), "p.txt:1:9"));
    }
    for (const char* bad : {"a", "0.5x", "0x1p-2", "+0.5", "0,5.5", "1e-400", "--", "\"0.5\"", "0.5;0.5"}) {
      CAPTURE(bad);
      CHECK(refusal("0.1,0.2\n" + std::string(bad) + ",0.5\n").starts_with("p.txt:2:"));
    }
    CHECK(contains(refusal("0.1,abc\n"), "\"abc\" is no number"));
    CHECK(is_at(refusal("0.1,abc\n"), "p.txt:1:5"));
  }

  TEST_CASE("every line has as many columns as the first") {
    CHECK(is_at(refusal("0.1\n"), "p.txt:1:1"));
    CHECK(contains(refusal("0.1\n"), "has 1 column;"));
    CHECK(contains(refusal("0.1,0.2,0.3,0.4\n"), "more than 3 columns"));
    CHECK(is_at(refusal("0.1,0.2,0.3,0.4\n"), "p.txt:1:13"));
    CHECK(is_at(refusal("0.1,0.2\n0.1,0.2,0.3\n"), "p.txt:2:9"));
    CHECK(contains(refusal("0.1,0.2\n0.1,0.2,0.3\n"), "3 columns; write 2 as in the lines before"));
    CHECK(contains(refusal("0.1,0.2,0.3\n#\n0.1,0.2\n"), "p.txt:3:"));
    // A comma at the end begins a column that is not there, and two commas have one between them.
    CHECK(refusal("0.1,0.2,\n") != "");
    CHECK(refusal("0.1,,0.2\n") != "");
    CHECK(refusal(",0.1\n") != "");
  }

  TEST_CASE("an input without points is refused") {
    for (const char* text : {"", "\n\n", "#\n", "x,y\n", "# a\nx,y,t\n#\n", " "}) {
      CAPTURE(text);
      CHECK(is_at(refusal(text), "p.txt"));
      CHECK(contains(refusal(text), "has no points"));
    }
  }

  TEST_CASE("lines that never end are refused, and so are bytes that are no text") {
    CHECK(contains(refusal(std::string(5000, '1')), "longer than 4096 bytes"));
    CHECK(is_at(refusal("0.1,0.2\n# " + std::string(5000, '-') + "\n"), "p.txt:2:1"));
    CHECK(contains(refusal(std::string(1 << 20, '\0')), "longer than 4096 bytes"));
    CHECK(refusal(std::string("0.1,0.2\n\0,1\n", 12)) != "");
  }

  TEST_CASE("more sets than the limit are refused: of one point each they would take ten gigabytes in a large file") {
    std::string text;
    for (std::size_t i = 0; i <= kMaxPointSets; ++i) text += "0,0\n#\n";
    CHECK(refusal(text) == "p.txt: has more sets than can be read; give 1000000 at most");
    CHECK(parse(text.substr(0, 6 * kMaxPointSets)).size() == kMaxPointSets);
  }

  TEST_CASE("how the bytes arrive makes no difference") {
    std::string text = "# first\nx,y\n";
    for (int i = 0; i < 300; ++i)
      text += std::to_string(i / 300.0) + "," + std::to_string(i / 301.0) + (i % 7 == 0 ? "\n#\n" : "\r\n");
    const std::vector<PointSet> whole = parse(text);
    CHECK(whole.size() == 43 + 1);
    for (const std::size_t step : {std::size_t{1}, std::size_t{3}, std::size_t{1000}}) {
      const std::vector<PointSet> parts = parse(text, step);
      REQUIRE(parts.size() == whole.size());
      for (std::size_t i = 0; i < whole.size(); ++i) {
        CHECK(parts[i].x == whole[i].x);
        CHECK(parts[i].y == whole[i].y);
      }
    }
  }

  TEST_CASE("a file is read by its name, and one that is not there is an error of input") {
    const test::TestFolder folder("point_sets");
    const std::string path = folder.write("sets.csv", "x,y\n0.5,0.5\n");
    CHECK(read_point_sets(path)[0].x == Numbers{0.5});
    const std::string missing = folder.file("none.csv");
    CHECK(is_at(message_of([&] { read_point_sets(missing); }), missing));
    CHECK(message_of([&] { read_point_sets(folder.file(".")); }) != "");
    CHECK(is_at(message_of([&] { read_point_sets(folder.write("bad.csv", "0.5,2\n")); }),
                folder.file("bad.csv") + ":1:5"));
  }

  TEST_CASE("doubles written with 17 digits read back as the same bits") {
    std::string text;
    Numbers want;
    std::uint64_t state = 1;
    for (int i = 0; i < 2000; ++i) {
      state = state * 6364136223846793005u + 1442695040888963407u;  // Knuth's MMIX generator
      const double x = static_cast<double>(state >> 11) * 0x1p-53;
      char digits[40];
      const auto end = std::to_chars(digits, digits + sizeof digits, x, std::chars_format::scientific, 16).ptr;
      text += std::string(digits, end) + ",0\n";
      want.push_back(x);
    }
    CHECK(parse(text)[0].x == want);
  }
}
