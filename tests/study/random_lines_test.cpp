// Random edges: their laws, against Crofton's formula, and what study files say of them.
#include "study/random_lines.h"

#include <doctest/doctest.h>

#include <cmath>
#include <set>
#include <string>
#include <vector>

#include "message.h"
#include "study/study.h"

using namespace moire;

namespace {

constexpr Grid kGrid{24, 16};
constexpr EdgeLaw kLaws[] = {EdgeLaw::isotropic, EdgeLaw::axis_aligned};

double side(const RandomLine& line, Vec2 p) {
  return (p.x - line.through.x) * line.normal.x + (p.y - line.through.y) * line.normal.y;
}

bool separates(const RandomLine& line, Vec2 a, Vec2 b) { return side(line, a) * side(line, b) < 0; }

std::string study_with(const std::string& scene) { return "patterns = [\"random\"]\n[[scene]]\n" + scene; }

const std::string kFrame = "kind = \"edge\"\nwidth = 24\nheight = 16\n";

std::string refusal(const std::string& scene) {
  return message_of([&] { parse_study(study_with(scene), "s.toml", "s"); });
}

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("a segment anywhere in the image separates its ends as often as its length says, in any direction") {
    // Crofton: lines that hit the convex image hit a segment of length d with probability 2 d / perimeter. Under the
    // axis-aligned law a segment counts with |dx| + |dy|, and the image with half its perimeter.
    constexpr int kLines = 100'000;
    const Vec2 segments[][2] = {{{12, 8}, {14, 8}},      {{0.5, 0.5}, {0.5, 3.5}}, {{20, 12}, {23, 15}},
                                {{1, 15}, {9, 10}},      {{3, 3}, {21, 3.5}},      {{23.2, 0.1}, {23.9, 0.8}},
                                {{11.5, 2}, {11.5, 14}}, {{0, 0}, {24, 16}}};
    for (const EdgeLaw law : kLaws) {
      std::vector<RandomLine> lines;
      for (std::uint32_t i = 0; i < kLines; ++i) lines.push_back(random_line(law, 7, i, kGrid));
      for (const auto& [a, b] : segments) {
        const double dx = std::fabs(a.x - b.x), dy = std::fabs(a.y - b.y);
        const double size = law == EdgeLaw::isotropic ? std::hypot(dx, dy) : dx + dy;
        const double expected = size / (kGrid.width + kGrid.height);
        int hits = 0;
        for (const RandomLine& line : lines) hits += separates(line, a, b);
        CAPTURE(a.x);
        CAPTURE(a.y);
        // 4.5 standard errors: 16 comparisons fail by chance with probability 1e-4, and the seed is fixed.
        CHECK(std::fabs(hits / double{kLines} - expected) <= 4.5 * std::sqrt(expected * (1 - expected) / kLines));
      }
    }
  }

  TEST_CASE("each line hits the image, has a normal of length 1, and both sides are inside equally often") {
    for (const EdgeLaw law : kLaws) {
      std::set<double> normals;
      int up = 0, right = 0;
      for (std::uint32_t i = 0; i < 10'000; ++i) {
        const RandomLine line = random_line(law, 1, i, kGrid);
        // A square root and a few products of numbers up to 1.
        CHECK(std::hypot(line.normal.x, line.normal.y) == doctest::Approx(1).epsilon(1e-15));
        double low = 0, high = 0;
        for (const Vec2 corner : {Vec2{0, 0}, Vec2{24, 0}, Vec2{0, 16}, Vec2{24, 16}}) {
          low = std::fmin(low, side(line, corner));
          high = std::fmax(high, side(line, corner));
        }
        CHECK(low < 0);
        CHECK(high > 0);
        right += line.normal.x > 0 || (line.normal.x == 0 && i % 2 == 0);
        up += line.normal.y > 0 || (line.normal.y == 0 && i % 2 == 0);
        if (law == EdgeLaw::axis_aligned) normals.insert(line.normal.x + 2 * line.normal.y);
      }
      // 4 standard errors of 10,000 fair coins.
      CHECK(std::abs(right - 5000) <= 200);
      CHECK(std::abs(up - 5000) <= 200);
      if (law == EdgeLaw::axis_aligned) CHECK(normals == std::set<double>{-2, -1, 1, 2});
    }
  }

  TEST_CASE("a line depends on its seed and number alone") {
    for (const EdgeLaw law : kLaws) {
      std::set<double> seen;
      for (const std::uint64_t seed : {0, 1, 2}) {
        for (std::uint32_t i = 0; i < 100; ++i) {
          const RandomLine line = random_line(law, seed, i, kGrid), again = random_line(law, seed, i, kGrid);
          CHECK(line.through == again.through);
          CHECK(line.normal == again.normal);
          seen.insert(line.through.x + 1000 * line.through.y);
        }
      }
      CHECK(seen.size() == 300);
    }
  }

  TEST_CASE("a scene with lines makes one edge per line, of one family, and more lines begin with the same ones") {
    const auto scenes = [](const std::string& lines) {
      return parse_study(study_with("name = \"a\"\n" + kFrame + "lines = " + lines + "\n"), "s.toml", "s").scenes;
    };
    const auto three = scenes("{ law = \"isotropic\", count = 3 }");
    REQUIRE(three.size() == 3);
    const auto five = scenes("{ count = 5, seed = 1, law = \"isotropic\" }");
    const auto other = scenes("{ law = \"isotropic\", count = 3, seed = 2 }");
    for (std::uint32_t i = 0; i < 3; ++i) {
      CHECK(three[i].name == "a:line=" + std::to_string(i));
      CHECK(scene_family(three[i].name) == "a");
      CHECK(line_number(three[i].name) == i);
      CHECK(three[i].image.grid() == kGrid);
      CHECK(three[i].image.stored() == five[i].image.stored());
      CHECK(three[i].image.stored() != other[i].image.stored());
      const RandomLine line = random_line(EdgeLaw::isotropic, 1, i, kGrid);
      const StoredDoubles want = {{"through", {line.through.x, line.through.y}},
                                  {"normal", {line.normal.x, line.normal.y}}};
      CHECK(three[i].image.stored() == want);
    }
    for (const char* name : {"a", "a:normal=1.5", "a:line=", "a:line=x", "a:line=1x", ":lines=3", ""}) {
      CHECK(scene_family(name) == name);
      CHECK(line_number(name) == 0);
    }
    CHECK(scene_family("a:line=2:line=10") == "a:line=2");
  }

  TEST_CASE("what is wrong with lines is refused where it stands") {
    const std::string good = "lines = { law = \"isotropic\", count = 2 }\n";
    CHECK(refusal(kFrame + good).empty());
    struct Bad {
      std::string scene, place, says;
    };
    const Bad bads[] = {
        {kFrame + "lines = { law = \"isotropc\", count = 2 }\n", "s.toml:6:17", "did you mean isotropic"},
        {kFrame + "lines = { law = 3, count = 2 }\n", "s.toml:6:17", "text in quotes"},
        {kFrame + "lines = { law = \"isotropic\" }\n", "s.toml:6:9", "\"count\""},
        {kFrame + "lines = { count = 2 }\n", "s.toml:6:9", "\"law\""},
        {kFrame + "lines = { law = \"isotropic\", count = 0 }\n", "s.toml:6:", "must be 1 to"},
        {kFrame + "lines = { law = \"isotropic\", count = 100001 }\n", "s.toml:6:", "must be 1 to"},
        {kFrame + "lines = { law = \"isotropic\", count = 2, sed = 1 }\n", "s.toml:6:", "did you mean seed"},
        {kFrame + "lines = { law = \"isotropic\", count = 2, seed = -1 }\n", "s.toml:6:", "seed is -1"},
        {kFrame + "lines = 5\n", "s.toml:6:9", "write {"},
        {kFrame + "linse = 5\n", "s.toml:6:1", "did you mean lines"},
        {kFrame + good + "normal = 3\n", "s.toml:7:1", "beside"},
        {kFrame + good + "through = [1, 2]\n", "s.toml:7:1", "beside"},
        {"kind = \"edge\"\nwidth = { from = 8, to = 16, step = 8 }\nheight = 4\n" + good, "s.toml:4:9", "range"},
        {"kind = \"edge\"\nheight = 4\n" + good, "s.toml:", "width"},
        {"kind = \"disk\"\nwidth = 8\nheight = 8\ncenter = [4, 4]\nradius = 2\n" + good, "s.toml:8:1", "edge"},
        {"name = \"a\"\n" + kFrame + good + "[[scene]]\nname = \"a\"\n" + kFrame + "through = [1, 2]\nnormal = 3\n",
         "s.toml:8:1", "\"a\" stands above"},
    };
    for (const Bad& bad : bads) {
      const std::string message = refusal(bad.scene);
      CAPTURE(bad.scene);
      CAPTURE(message);
      CHECK(message.starts_with(bad.place));
      CHECK(contains(message, bad.says));
    }
    CHECK(contains(message_of([&] { parse_scene(kFrame + good, "e.toml", "e"); }), "e.toml:4:9: lines make"));
  }
}
