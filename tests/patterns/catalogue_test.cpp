// What every pattern of the catalogue promises.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "chi_square.h"
#include "core/error.h"
#include "patterns/pattern.h"
#include "patterns/variants.h"

using namespace moire;
using namespace moire::test;

namespace {

const std::vector<Pixel>& scattered_pixels() {
  static const std::vector<Pixel> kPixels = {
      {0, 0},
      {1, 0},
      {0, 1},
      {-1, 0},
      {0, -1},
      {-1, -1},
      {17, 300},
      {511, 511},
      {-4096, 12},
      {std::int64_t{1} << 40, 3},
      {1, 1},
      {2, 1},
      {1, 2},
      {-(std::int64_t{1} << 40), 5},
      {std::numeric_limits<std::int64_t>::max(), std::numeric_limits<std::int64_t>::min()}};
  return kPixels;
}

bool in_unit_cube(const PointSet& set) {
  const auto inside = [](double v) { return v >= 0.0 && v < 1.0; };  // false for NaN as well
  return std::all_of(set.x.begin(), set.x.end(), inside) && std::all_of(set.y.begin(), set.y.end(), inside) &&
         std::all_of(set.t.begin(), set.t.end(), inside);
}

template <class Question>
std::string message_from(const Question& question) {
  try {
    question();
  } catch (const Error& error) {
    CHECK(error.code() == Exit::usage);
    return error.what();
  }
  return "";
}

std::string message_of(const PatternChoice& choice, std::int64_t n) {
  return message_from([&] { choice.require_count(n); });
}

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("all points lie in [0, 1) on every axis, and a run gets exactly n of them per pixel") {
    for (const std::string& text : variants())
      for (const int wanted : {1, 2, 3, 5, 16, 17, 64}) {
        const PatternChoice choice = chosen(text);
        const int n = usable(choice, wanted);
        CAPTURE(text);
        CAPTURE(n);
        const Pattern pattern(choice, n, {.seed = 5, .trial = 2});
        CHECK(pattern.n() == n);
        CHECK(pattern.has_time() == choice.has_time());
        CHECK(in_unit_cube(points_in(pattern, scattered_pixels())));
        CHECK(in_unit_cube(set_of(text, n)));

        // A run of 3 pixels writes 3 n points and not one more.
        const auto count = 3 * static_cast<std::size_t>(n);
        PointSet room = room_for(count + 8, pattern.has_time());
        pattern.fill(std::span(scattered_pixels()).first(3), points_of(room).part(0, count));
        for (const auto* v : {&room.x, &room.y, &room.t}) {
          if (v->empty()) continue;
          CHECK(std::count(v->begin(), v->end(), -1.0) == 8);
          CHECK(std::all_of(v->end() - 8, v->end(), [](double end) { return end == -1.0; }));
        }
      }
  }

  TEST_CASE("the points of a pixel depend neither on the run nor on the order in which they are asked for") {
    const std::vector<Pixel>& pixels = scattered_pixels();
    for (const std::string& text : variants())
      for (const int wanted : {1, 5, 16}) {
        const PatternChoice choice = chosen(text);
        const int n = usable(choice, wanted);
        CAPTURE(text);
        CAPTURE(n);
        const Draw draw{.seed = 9, .trial = 1};
        const Pattern pattern(choice, n, draw);
        const PointSet whole = points_in(pattern, pixels);
        for (const std::size_t length : {1u, 2u, 5u}) {
          const Pattern again(choice, n, draw);  // backwards, in runs of `length`, by a pattern of its own
          PointSet pieces = room_for(whole.x.size(), pattern.has_time());
          for (std::size_t end = pixels.size(); end > 0;) {
            const std::size_t begin = end > length ? end - length : 0, per = static_cast<std::size_t>(n);
            again.fill(std::span(pixels).subspan(begin, end - begin),
                       points_of(pieces).part(begin * per, (end - begin) * per));
            end = begin;
          }
          CHECK(pieces == whole);
        }
        CHECK(set_of(text, n, draw) == set_of(text, n, draw));
      }
  }

  TEST_CASE("asking for times does not change a bit of x and y") {
    for (const std::string& text : variants()) {
      const PatternChoice choice = chosen(text);
      if (!choice.has_time()) continue;
      CAPTURE(text);
      for (const int wanted : {1, 5, 16, 64}) {
        const int n = usable(choice, wanted);
        const Pattern pattern(choice, n, {.seed = 5, .trial = 2});
        PointSet still = room_for(scattered_pixels().size() * static_cast<std::size_t>(n), false);
        pattern.fill(scattered_pixels(), points_of(still));
        PointSet timed = points_in(pattern, scattered_pixels());
        CHECK(still.x == timed.x);
        CHECK(still.y == timed.y);
        still = room_for(static_cast<std::size_t>(n), false);
        pattern.fill_set(points_of(still));
        timed = set_of(text, n, {.seed = 5, .trial = 2});
        CHECK(still.x == timed.x);
        CHECK(still.y == timed.y);
      }
    }
  }

  TEST_CASE("points differ by seed, trial and pixel, or never, as the pattern says") {
    for (const std::string& text : variants()) {
      CAPTURE(text);
      const PatternChoice choice = chosen(text);
      const int n = usable(choice, 16);
      const auto at = [&](Draw draw, Pixel pixel) { return points_in(Pattern(choice, n, draw), {pixel}); };
      const PointSet base = at({.seed = 1, .trial = 0}, {3, 4});
      const std::vector<PointSet> others = {
          at({.seed = 2, .trial = 0}, {3, 4}), at({.seed = std::uint64_t{1} << 63, .trial = 0}, {3, 4}),
          at({.seed = 1, .trial = 1}, {3, 4}), at({.seed = 1, .trial = 0}, {4, 4}),
          at({.seed = 1, .trial = 0}, {3, 5}), at({.seed = 1, .trial = 0}, {4, 3}),
          at({.seed = 1, .trial = 0}, {-3, 4})};
      for (const PointSet& other : others) {
        CHECK((other.x != base.x) == choice.varies());
        CHECK((other.y != base.y) == choice.varies());
        CHECK((other.t != base.t) == (choice.varies(true) && choice.has_time()));
      }
      for (const Draw draw : {Draw{.seed = 1, .trial = 1}, Draw{.seed = 2, .trial = 0}}) {
        const PointSet one = set_of(text, n, {.seed = 1, .trial = 0}), other = set_of(text, n, draw);
        CHECK((one.x != other.x) == choice.varies());
        CHECK((one.t != other.t) == (choice.varies(true) && choice.has_time()));
      }
    }
  }

  TEST_CASE("the counts below and above any n are counts themselves") {
    for (const std::string& text : variants()) {
      CAPTURE(text);
      const PatternChoice choice(parse_spec(text, "test"));
      const auto counts = [&](int n) { return choice.info().counts(choice.args(), n); };
      std::vector<int> around = {kMaxSamples - 1, kMaxSamples, 4095 * 4095 - 1, 4095 * 4095, 4095 * 4095 + 1, 46340};
      for (int n = 1; n <= 300; ++n) around.push_back(n);
      for (const int n : around) {
        CAPTURE(n);
        const auto [below, above] = counts(n);
        CHECK(below >= 1);
        CHECK(below <= n);
        CHECK(above >= n);
        CHECK(above <= kMaxSamples);
        CHECK((below == n) == (above == n));
        for (const int c : {below, above}) {
          CHECK(counts(c).below == c);
          CHECK(counts(c).above == c);
        }
      }
    }
  }

  TEST_CASE("square counts are the squares") {
    for (int m = 1; m <= 4096; ++m) {
      REQUIRE(square_count({}, m * m).below == m * m);
      REQUIRE(square_count({}, m * m).above == m * m);
      if (m < 4096) REQUIRE(square_count({}, m * m + 1).below == m * m);
      if (m < 4096) REQUIRE(square_count({}, m * m + 1).above == (m + 1) * (m + 1));
      if (m > 1) REQUIRE(square_count({}, m * m - 1).below == (m - 1) * (m - 1));
    }
    CHECK(square_count({}, std::numeric_limits<int>::max()).below == kMaxSamples);
  }

  TEST_CASE("a count that a pattern cannot have is refused with the nearest counts that it can") {
    const PatternChoice jittered = chosen("jittered");
    CHECK(message_of(jittered, 10) == "test: pattern \"jittered\" cannot have 10 samples per pixel; nearest: 9, 16");
    CHECK(message_of(jittered, 16).empty());
    for (const PatternInfo* info : patterns()) {
      const PatternChoice choice = chosen(std::string(info->name));
      for (const std::int64_t n :
           {std::int64_t{0}, std::int64_t{-1}, std::int64_t{kMaxSamples} + 1, std::int64_t{1'000'000'000},
            std::numeric_limits<std::int64_t>::max(), std::numeric_limits<std::int64_t>::min()}) {
        const std::string message = message_of(choice, n);
        CHECK(message.find(std::to_string(n)) != std::string::npos);
        CHECK(message.find(std::to_string(kMaxSamples)) != std::string::npos);
      }
      CHECK_THROWS_AS(Pattern(choice, 0, {}), Error);
    }
    CHECK_THROWS_AS(Pattern(jittered, 10, {}), Error);
  }

  TEST_CASE("a pattern without a time is refused, where one is needed, with those that have one") {
    CHECK(message_from([] { chosen("regular").require_time(); }) ==
          "test: pattern \"regular\" has points in 2 dimensions, without a time; these have one: random, hammersley, "
          "zaremba, jittered-random-time, scan-time");
    for (const PatternInfo* info : patterns()) {
      CAPTURE(info->name);
      const PatternChoice choice = chosen(std::string(info->name));
      CHECK(choice.has_time() == message_from([&] { choice.require_time(); }).empty());
    }
  }

  TEST_CASE("names are unique, and an unknown one is answered with its neighbours") {
    std::set<std::string_view> names;
    for (const PatternInfo* info : patterns()) {
      CAPTURE(info->name);
      CHECK(names.insert(info->name).second);
      CHECK(&find_pattern(info->name, "") == info);
      CHECK(!info->title.empty());
      CHECK(!info->cite.empty());
      for (const Param& p : info->params) CHECK(!p.help.empty());
    }
    for (const char* name : {"regular", "random", "jittered", "n-rooks", "dart-throwing", "hammersley", "zaremba",
                             "jittered-random-time", "scan-time"})
      CHECK(names.count(name) == 1);
    CHECK_THROWS_WITH_AS(find_pattern("jitterd", "file.toml:7:12"), doctest::Contains("jittered"), Error);
    CHECK_THROWS_WITH_AS(find_pattern("jitterd", "file.toml:7:12"), doctest::Contains("file.toml:7:12: "), Error);
  }

  TEST_CASE("a choice keeps its text and refuses parameters that its pattern does not have") {
    CHECK(chosen("zaremba:instance=shift").text() == "zaremba:instance=shift");
    CHECK(chosen("zaremba:instance=shift").args().text("instance") == "shift");
    CHECK(chosen("zaremba").args().text("instance") == "fixed");
    for (const char* text : {"zaremba:instance=random", "random:amount=1", "jittered:amount=1.5", "jittered:amount=nan",
                             "dart-throwing:bank=-1", "dart-throwing:bank=4097", "dart-throwing:k=0",
                             "dart-throwing:k=1.5", "scan-time:k=0", "scan-time:k=257", "scan-time:amount=1"})
      CHECK_THROWS_AS(chosen(text), Error);
  }
}

TEST_SUITE("heavy") {
  TEST_CASE("a randomly chosen point of a pattern that varies is uniform over pixels and over trials") {
    for (const std::string& text : variants()) {
      const PatternChoice choice = chosen(text);
      if (!choice.varies(true)) continue;
      CAPTURE(text);
      const int n = usable(choice, 4);
      constexpr int kPoints = 2048;
      std::mt19937 random(12345);  // which point: its numbers are fixed by the standard
      // Counts in 8 x 8 cells of (x, y), (x, t) and (y, t), and in 64 of t; empty where there is nothing to count.
      using Counts = std::array<std::vector<std::uint32_t>, 4>;
      Counts over_pixels;
      for (std::size_t c = 0; c < over_pixels.size(); ++c)
        if ((choice.varies() || c == 3) && (choice.has_time() || c == 0)) over_pixels[c].resize(64);
      Counts over_trials = over_pixels;
      const auto count = [&](Counts& counts, const PointSet& set) {
        const std::size_t i = random() % static_cast<std::size_t>(n);
        const double x = set.x[i], y = set.y[i], t = set.t.empty() ? 0 : set.t[i];
        const auto eighth = [](double v) { return static_cast<std::size_t>(v * 8); };
        const std::size_t cells[] = {eighth(x) * 8 + eighth(y), eighth(x) * 8 + eighth(t), eighth(y) * 8 + eighth(t),
                                     static_cast<std::size_t>(t * 64)};
        for (std::size_t c = 0; c < counts.size(); ++c)
          if (!counts[c].empty()) ++counts[c][cells[c]];
      };
      const Pattern pattern(choice, n, {.seed = 3});
      for (int i = 0; i < kPoints; ++i) count(over_pixels, points_in(pattern, {{i % 64 - 32, i / 64 - 8}}));
      for (std::uint32_t t = 0; t < kPoints; ++t)
        count(over_trials, points_in(Pattern(choice, n, {.seed = 3, .trial = t}), {{7, 7}}));
      for (const Counts* counts : {&over_pixels, &over_trials})
        for (const auto& cells : *counts)
          if (!cells.empty()) CHECK(std::abs(z_of_counts(cells)) < 5);
    }
  }

  TEST_CASE("at 2^24 samples no coordinate reaches 1") {
    // Left out, since they take long: dart-throwing, whose numbers are those of `random`, shifted, and scan-time, whose
    // numbers are those of `jittered` and candidates like those of `random`.
    for (const std::string& text : variants()) {
      if (text.starts_with("dart-throwing") || text.starts_with("scan-time")) continue;
      CAPTURE(text);
      CHECK(in_unit_cube(set_of(text, kMaxSamples)));
    }
  }
}
