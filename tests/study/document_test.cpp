// TOML as plain values with places, and ranges of numbers.
#include "study/document.h"

#include <doctest/doctest.h>

#include <cstdint>
#include <string>

#include "message.h"
#include "study/scene_file.h"

using namespace moire;

namespace {

Node value_of_text(const std::string& text) { return parse_toml("v = " + text, "f").items.at(0); }

std::vector<double> range_of(const std::string& from, const std::string& to, const std::string& step,
                             std::size_t limit = 1000) {
  return range_values(value_of_text("{ from = " + from + ", to = " + to + ", step = " + step + " }"), limit);
}

// n / 10 as a decimal.
std::string tenths(int n) {
  return (n < 0 ? "-" : "") + std::to_string(std::abs(n) / 10) + "." + std::to_string(std::abs(n) % 10);
}

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("values keep the order of the text and know where they stand") {
    const Node root = parse_toml("zoo = 1\napple = [1.5, \"x\"]\n[b]\nc = true\n", "dir/f.toml");
    REQUIRE(root.items.size() == 3);
    CHECK(root.items[0].key == "zoo");
    CHECK(root.items[0].kind == Node::Kind::integer);
    CHECK(root.items[0].place == "dir/f.toml:1:7");
    CHECK(root.items[1].key == "apple");
    CHECK(root.items[1].key_place == "dir/f.toml:2:1");
    REQUIRE(root.items[1].items.size() == 2);
    CHECK(root.items[1].items[0].number == 1.5);
    CHECK(root.items[1].items[1].place == "dir/f.toml:2:15");
    REQUIRE(root.find("b") != nullptr);
    CHECK(root.find("b")->find("c")->kind == Node::Kind::boolean);
    CHECK(root.find("none") == nullptr);
  }

  TEST_CASE("a text that is not TOML is refused at its line and column") {
    const char* const texts[] = {"a = [1, 2",
                                 "a = ",
                                 "a = \"x",
                                 "a = 1\na = 2",
                                 "[s]\n[s]",
                                 "a = 1e400",
                                 "= 3",
                                 "a = {b = 1",
                                 "\xff\xfe",
                                 "a b = 1",
                                 "a = 9999999999999999999",
                                 "a\0=1",
                                 "[[s]\n"};
    for (const char* text : texts) {
      CAPTURE(text);
      const std::string message = message_of([&] { parse_toml(text, "f.toml"); });
      CHECK(message.starts_with("f.toml:"));
      CHECK(contains(message, "this is not TOML"));
      CHECK(message.find('\n') == std::string::npos);
    }
    CHECK(message_of([] { parse_toml("a = 1\na = 2", "f"); }).starts_with("f:2:"));
  }

  TEST_CASE("numbers are finite doubles, and integers that no double holds are refused") {
    CHECK(exact_number(value_of_text("3")) == 3.0);
    CHECK(exact_number(value_of_text("-2.5e-3")) == -2.5e-3);
    CHECK(exact_number(value_of_text("9007199254740992")) == 0x1p53);
    CHECK(exact_number(value_of_text("-9223372036854775808")) == -0x1p63);
    for (const char* text : {"9007199254740993", "9223372036854775807", "nan", "inf", "-inf", "\"3\"", "true", "[3]",
                             "{a = 3}", "1979-05-27"}) {
      CAPTURE(text);
      CHECK(message_of([&] { exact_number(value_of_text(text)); }).starts_with("f:1:5: "));
    }
  }

  TEST_CASE("whole numbers are checked against their limits") {
    CHECK(integer_of(value_of_text("5"), "n", 1, 5) == 5);
    CHECK(contains(message_of([] { integer_of(value_of_text("6"), "n", 1, 5); }), "n is 6; it must be 1 to 5"));
    CHECK(contains(message_of([] { integer_of(value_of_text("2.0"), "n", 1, 5); }), "whole number from 1 to 5"));
  }

  TEST_CASE("a range of decimals gives the doubles nearest to the decimals, its end included when it is hit") {
    // In units of a tenth everything is exact, and i / 10.0 is the correctly rounded decimal.
    for (int from = -30; from <= 30; from += 7) {
      for (int step = -17; step <= 17; ++step) {
        for (int steps = 0; step != 0 && steps < 40; ++steps) {
          for (int rest = 0; rest < std::abs(step); rest += 5) {
            const int to = from + steps * step + (step > 0 ? rest : -rest);
            const std::vector<double> values = range_of(tenths(from), tenths(to), tenths(step));
            REQUIRE(values.size() == static_cast<std::size_t>(steps) + 1);
            for (int k = 0; k <= steps; ++k) REQUIRE(values[static_cast<std::size_t>(k)] == (from + k * step) / 10.0);
          }
        }
      }
    }
    CHECK(range_of("0.0", "90.0", "1.5").size() == 61);
  }

  TEST_CASE("a range begins with its first number bit for bit, however many digits that has") {
    const std::vector<double> values = range_of("0.33333333333333331", "1", "0.25");
    REQUIRE(values.size() == 3);
    CHECK(values[0] == 1.0 / 3);
    // No decimal of 15 digits lies within the rounding of 1/3 + 1/4: the sum stays.
    CHECK(values[1] == 1.0 / 3 + 0.25);
  }

  TEST_CASE("a range that leads away, stands still, or is endless is refused") {
    CHECK(contains(message_of([] { range_of("0", "1", "0"); }), "does not lead"));
    CHECK(contains(message_of([] { range_of("0", "1", "-0.5"); }), "does not lead"));
    CHECK(contains(message_of([] { range_of("1e17", "100000000000000064.0", "1"); }), "below the spacing"));
    CHECK(contains(message_of([] { range_of("0", "1000", "1"); }), "more than 1000"));
    CHECK(range_of("0", "999", "1").size() == 1000);
    CHECK(contains(message_of([] { range_of("-1.7e308", "1.7e308", "1"); }), "more than 1000"));
    CHECK(contains(message_of([] { range_of("0", "1", "5e-324"); }), "more than 1000"));
    CHECK(contains(message_of([] { range_values(value_of_text("{ from = 1, to = 2 }"), 9); }), "no \"step\""));
    CHECK(contains(message_of([] { range_values(value_of_text("{ from = 1, to = 2, setp = 1 }"), 9); }),
                   "did you mean step"));
    CHECK(range_of("5", "5", "1") == std::vector<double>{5.0});
  }
}
