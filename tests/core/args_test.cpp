// What people type: names, key=value, numbers; and what they are told.
#include <doctest/doctest.h>

#include <string>

#include "core/args.h"
#include "core/error.h"
#include "core/names.h"

using namespace moire;

namespace {

constexpr Param kParams[] = {number("size", 2, 0.5, 8, "size in pixels"), integer("k", 3, 1, 10, "a count"),
                             choice("mode", "slow", "slow|fast", "how")};

Args parse(std::string_view text) {
  const Spec s = parse_spec(text, "here");
  return Args("thing \"" + s.name + "\"", kParams, s.given, s.place);
}

std::string message(std::string_view text) {
  try {
    parse(text);
  } catch (const Error& e) {
    CHECK(e.code() == Exit::usage);
    return e.what();
  }
  return "no error";
}

bool mentions(const std::string& text, std::string_view part) { return text.find(part) != std::string::npos; }

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("what is not given has its default, what is given its value") {
    const Args a = parse("thing:k=7,mode=fast");
    CHECK(a.number("size") == 2);
    CHECK(a.integer("k") == 7);
    CHECK(a.text("mode") == "fast");
    CHECK(parse("thing").text("mode") == "slow");
    CHECK(parse("thing:size=+1e0").number("size") == 1);
  }

  TEST_CASE("every error names the place, the fault and what would be right") {
    CHECK(
        mentions(message("thing:siz=3"), "here: thing \"thing\": parameter \"siz\" is not known; did you mean size?"));
    CHECK(mentions(message("thing:size=9"), "it must be 0.5 to 8"));
    CHECK(mentions(message("thing:size=nan"), "not a number"));
    CHECK(mentions(message("thing:size="), "not a number"));
    CHECK(mentions(message("thing:size=1x"), "not a number"));
    CHECK(mentions(message("thing:k=2.5"), "not a whole number"));
    CHECK(mentions(message("thing:k=1e30"), "it must be 1 to 10"));
    CHECK(
        message("thing:mode=fats") ==
        "here: thing \"thing\": parameter \"mode\": value \"fats\" is not known; did you mean fast? (all: slow, fast)");
    CHECK(mentions(message("thing:k=1,k=2"), "given twice"));
    CHECK(mentions(message("thing:"), "key=value"));
    CHECK(mentions(message("thing:k"), "key=value"));
    CHECK(mentions(message("thing:=1"), "key=value"));
    CHECK(mentions(message(":k=1"), "a name is missing"));
    CHECK(mentions(message(""), "a name is missing"));
  }

  TEST_CASE("a path must be given, starts from its folder and fits into a name") {
    constexpr Param kPath[] = {path("path", "a file"), number("n", 1, 0, 9, "a number")};
    const auto make = [&](std::string_view text, const std::string& folder) {
      Spec s = parse_spec(text, "here");
      for (auto& [key, value] : s.given) value.folder = folder;
      return Args("thing", kPath, s.given, s.place);
    };
    CHECK(make("thing:path=a/b.csv", "").path("path") == "a/b.csv");
    CHECK(make("thing:path=a/b.csv", "deep").path("path") == "deep/a/b.csv");
    CHECK(make("thing:path=a/b.csv", "deep").text("path") == "a/b.csv");
    CHECK(make("thing:path=/a/b.csv", "deep").path("path") == "/a/b.csv");
    CHECK_THROWS_WITH_AS(make("thing", ""), "here: thing needs \"path\": a file", Error);
    CHECK_THROWS_AS(make("thing:path=", ""), Error);
    CHECK_THROWS_AS(make("thing:path=a\tb", ""), Error);
    CHECK_THROWS_AS(make("thing:path=a`b", ""), Error);
    CHECK(mentions(message("thing:path=a,b.csv"), "cannot have a comma"));
    CHECK_FALSE(mentions(message("thing:k=1,b.csv"), "comma"));
  }

  TEST_CASE("the distance between names counts a swap of neighbours as one slip") {
    CHECK(edit_distance("", "abc") == 3);
    CHECK(edit_distance("jitterd", "jittered") == 1);
    CHECK(edit_distance("zarmeba", "zaremba") == 1);
    CHECK(edit_distance("kitten", "sitting") == 3);
    const std::string_view known[] = {"regular", "jittered", "zaremba"};
    CHECK(mentions(unknown_name("pattern", "jitterd", known), "did you mean jittered?"));
    CHECK(mentions(unknown_name("pattern", "xyz", known), "choose from regular, jittered, zaremba"));
    CHECK(unknown_name("pattern", std::string(100000, 'x'), known).size() < 300);
  }

  TEST_CASE("numbers are read whole, finite and without the locale") {
    double x = 0;
    CHECK(parse_number("1.5", x));
    CHECK(x == 1.5);
    for (const char* bad : {"", " 1", "1 ", "1,5", "inf", "nan", "0x10", "1e999", "--1", "1e"}) {
      CAPTURE(bad);
      CHECK_FALSE(parse_number(bad, x));
    }
    CHECK(shortest(0.1) == "0.1");
    CHECK(shortest(1.0 / 3) == "0.3333333333333333");
  }
}
