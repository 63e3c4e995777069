// Skipping inside a pixel: counting whole cells and testing only those that the boundary may cross gives the same
// count, and so the same bits, as testing every sample; and it tests few.
#include <doctest/doctest.h>

#include <cmath>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "catalogue.h"
#include "engine/box_count.h"
#include "engine/count_inside.h"
#include "engine/render.h"
#include "engine/skipping.h"

using namespace moire;
using namespace moire::test;

namespace {

using Scenes = std::vector<std::pair<std::string, TestImage>>;

// Patterns whose points lie in cells, in all the ways that they can.
std::vector<PatternChoice> patterns_with_cells() {
  std::vector<PatternChoice> all;
  for (const PatternInfo* p : patterns()) {
    if (p->least_for_cells > 0) all.emplace_back(parse_spec(p->name, "test"));
  }
  for (const char* name : {"regular", "hammersley", "zaremba"}) {
    for (const char* instance : {"shift", "scramble"}) {
      all.emplace_back(parse_spec(std::string(name) + ":instance=" + instance, "test"));
    }
  }
  for (const char* text : {"jittered:amount=0", "jittered:amount=0.5", "jittered:cells=oblong"}) {
    all.emplace_back(parse_spec(text, "test"));
  }
  return all;
}

double steps_from(double v, int ulps) {
  for (int i = 0; i < std::abs(ulps); ++i) v = std::nextafter(v, ulps > 0 ? HUGE_VAL : -HUGE_VAL);
  return v;
}

// What a rounding could decide: boundaries on the sides and corners of cells of 8, 12, 16 and 32 to a side, through
// samples, touching sides from either side, within a few ulp of all that; sets much smaller than a cell, and circles so
// large or so far that their equations cancel.
Scenes hard_scenes(Grid grid = {12, 10}) {
  using namespace scenes;
  Scenes all;
  const auto add = [&](std::string name, const TestImage& scene) { all.emplace_back(std::move(name), scene); };
  for (const int ulps : {-1, 0, 1}) {
    const std::string near = " moved by " + std::to_string(ulps) + " ulp";
    const double side = steps_from(5 + 3.0 / 16, ulps), twelfth = steps_from(4 + 5.0 / 12, ulps);
    for (const double angle : {0.0, 90.0, 180.0, 270.0}) {
      add("edge on a side of cells" + near, edge({side, side}, angle, grid));
      add("edge on a twelfth" + near, edge({twelfth, twelfth}, angle, grid));
      add("edge on pixel sides" + near, edge({steps_from(6, ulps), steps_from(5, ulps)}, angle, grid));
    }
    for (const Vec2 normal :
         {Vec2{1, 1}, Vec2{-1, 1}, Vec2{1, -2}, Vec2{-3, -1}, Vec2{0x1p-40, 1}, Vec2{-1e-300, -1}}) {
      add("edge through corners of cells" + near, edge({side, 4.25}, normal, grid));
    }
    // Left, right, upper and lower side touch x = side or y = side, from within a cell's row and on a corner.
    for (const double radius : {2.5, 1.0 / 32, 300.0}) {
      add("disk touching a side" + near, disk({side + radius, 4.25}, radius, grid));
      add("disk touching a side" + near, disk({side - radius, 4.27}, radius, grid));
      add("disk touching a row" + near, disk({6.25, side + radius}, radius, grid));
      add("disk touching a row" + near, disk({6.27, side - radius}, radius, grid));
    }
  }
  // Point i = 5 of 16, 64 and 256 Hammersley points is (5 / n, 5 / 8): the line and the circle go through them.
  for (const double n : {64.0, 256.0}) {
    add("edge through a sample", edge({5 + 5 / n, 4.625}, {0.3, 0.7}, grid));
    add("edge through many samples", edge({5 + 5 / n, 4.625}, {1, 0}, grid));
    add("disk through a sample", disk({5 + 5 / n + 3, 4.625}, 3, grid));
  }
  for (const double radius : {1e-100, 1e-9, 1e-3, 0.02}) {
    add("tiny disk in a cell", disk({5.53, 4.47}, radius, grid));
    add("tiny disk on a corner", disk({5.5, 4.5}, radius, grid));
  }
  add("disk as a pixel", disk({5.5, 4.5}, 0.5, grid));
  for (const double far : {1023.5, 1025.5, 1e5, 1e9, 1e14}) {
    for (const Vec2 to : {Vec2{1, 0}, Vec2{-1, 0}, Vec2{0, 1}, Vec2{0, -1}, Vec2{0.6, 0.8}, Vec2{-0.8, 0.6}}) {
      add("large disk", disk({6.3 + far * to.x, 5.2 + far * to.y}, far, grid));
    }
  }
  // Found by halving: no strips.
  add("board",
      board({.focal = 11, .principal = {6, 4}, .height = 1.5, .pitch = 25, .yaw = 7, .roll = 3}, {-3, 4, 1, 9}, grid));
  add("board on sides of cells", board({0.8, 0, -1, 0, 0.8, -1, 0, 0, 1}, {0, 7, 0, 6}, grid));
  add("two disks", disks({5.25, 4.5, 0.2, 5.75, 4.5, 0.2}, grid));
  add("near edge of a far plane", edge({1e9 + 0.25, 5.5}, {1e-9, 1}, grid));
  return all;
}

// Pixels whose counts differ between the two ways; adds the tests made to `tested`.
int differences(const TestImage& scene, const Pattern& pattern, std::int64_t& tested) {
  BoxCounter counter(scene, pattern);
  if (!counter.has_cells()) return 0;
  const Grid grid = scene.grid();
  std::vector<std::int64_t> all(static_cast<std::size_t>(grid.width));
  int count = 0;
  for (int y = 0; y < grid.height; ++y) {
    counter.test_all(0, grid.width, y, all);
    for (int x = 0; x < grid.width; ++x) {
      const BoxCounter::Count few = counter.test_crossed({x, y});
      count += few.inside != all[static_cast<std::size_t>(x)] || few.tested > pattern.n();
      tested += few.tested;
    }
  }
  return count;
}

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("ones are counted right, whatever their number and place") {
    std::vector<std::uint8_t> bytes(5000);
    for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = (i * i / 7) % 3 == 0;
    for (const std::size_t begin : {0u, 1u, 5u}) {
      for (const std::size_t size : {0u, 1u, 7u, 8u, 9u, 255u, 2039u, 2040u, 2048u, 4995u}) {
        const std::span<const std::uint8_t> part(bytes.data() + begin, size);
        CHECK(count_inside(part) == std::accumulate(part.begin(), part.end(), std::int64_t{0}));
      }
    }
    const std::vector<std::uint8_t> ones(4999, 1);  // no byte of a sum may overflow
    CHECK(count_inside(ones) == 4999);
  }

  TEST_CASE("an edge crosses at most two cells more than there are rows and columns, and no others are tested") {
    // A line crosses at most columns + rows - 1 cells. Two rows or columns more are touched where a line runs along
    // their sides; and one row and one column of a shifted grid are tested besides.
    for (const PatternChoice& choice : patterns_with_cells()) {
      if (choice.text().find("oblong") != std::string::npos) continue;
      for (const int n : {1024, 4096}) {
        const Pattern pattern(choice, n, {7, 3});
        const int side = n == 1024 ? 32 : 64;
        for (const double angle : {0.0, 17.3, 45.0, 97.3, 200.0}) {
          const TestImage scene = scenes::edge({4.3, 4.1}, angle, {8, 8});
          BoxCounter counter(scene, pattern);
          REQUIRE(counter.has_cells());
          for (int i = 0; i < 64; ++i) {
            const CellGrid cells = pattern.cells({i % 8, i / 8});
            // Two points of a low-discrepancy set or of darts may share a cell: at most four.
            const int each = choice.info().name.substr(0, 8) == "jittered" ? 1 : 4;
            const int most = each * ((2 * side + 2) + (cells.right > 0 ? 2 * side : 0));
            CHECK(counter.test_crossed({i % 8, i / 8}).tested <= most);
          }
        }
      }
    }
  }

  TEST_CASE("a 4096 x 4096 edge of 256 jittered samples needs less than one in 20,000 of them") {
    const TestImage scene = scenes::edge({2048.3, 2047.1}, 97.3, {4096, 4096});
    const Filter box(parse_spec("box", "test"));
    const Pattern pattern(PatternChoice(parse_spec("jittered", "test")), 256, {});
    const Rendered r = render(scene, pattern, box, Estimator::ratio, enumerate(scene, box.radius()));
    CHECK(r.samples_total == std::int64_t{256} * 4096 * 4096);
    CHECK(r.samples_evaluated * 20000 < r.samples_total);
  }

  TEST_CASE("where disks crowd a pixel, halving is given up and all samples are tested") {
    // 900 disks a pixel: no block of cells is clear of them.
    std::vector<double> circles;
    for (int i = 0; i < 30; ++i) {
      for (int j = 0; j < 30; ++j) circles.insert(circles.end(), {(i + 0.5) / 30, (j + 0.5) / 30, 0.011});
    }
    const TestImage scene = scenes::disks(circles, {1, 1});
    const Pattern pattern(PatternChoice(parse_spec("jittered", "test")), 4096, {7, 3});
    std::int64_t tested = 0;
    CHECK(differences(scene, pattern, tested) == 0);
    CHECK(tested == 4096);
  }
}

// Too slow under sanitizers.
TEST_SUITE("heavy") {
  TEST_CASE("the samples of crossed cells suffice: every pixel of hard scenes has the count of all its samples") {
    const Scenes scenes = hard_scenes();
    for (const PatternChoice& choice : patterns_with_cells()) {
      for (const int wanted : {100, 144, 256, 1024, 2304}) {
        const Pattern pattern(choice, choice.info().counts(choice.args(), wanted).above, {7, 3});
        for (const auto& named : scenes) {
          const std::string& name = named.first;
          std::int64_t tested = 0;
          const int wrong = differences(named.second, pattern, tested);
          if (wrong == 0) continue;
          CAPTURE(choice.text());
          CAPTURE(wanted);
          CAPTURE(name);
          CHECK(wrong == 0);
        }
      }
    }
  }

  TEST_CASE("skipping inside a pixel changes no bit: every pattern and estimator on every scene under the unit box") {
    const Filter box(parse_spec("box", "test"));
    std::vector<PatternChoice> choices = patterns_with_cells();
    for (const PatternChoice& choice : pattern_catalogue()) {
      if (choice.info().least_for_cells == 0) choices.push_back(choice);
    }
    for (const PatternChoice& choice : choices) {
      for (const int wanted : {64, 1024}) {
        // Sets that are made anew in each pixel, or scanned in time, take too long with many points.
        if (wanted > 64 && choice.info().least_for_cells == 0) continue;
        const Pattern pattern(choice, choice.info().counts(choice.args(), wanted).above, {7, 3});
        for (const auto& named : scene_catalogue()) {
          const std::string& name = named.first;
          const TestImage& scene = named.second;
          CAPTURE(choice.text());
          CAPTURE(wanted);
          CAPTURE(name);
          const ActiveRows rows = enumerate(scene, box.radius());
          for (const std::string_view estimator_name : estimator_names()) {
            const Estimator estimator = find_estimator(estimator_name, "test");
            const Rendered some = render(scene, pattern, box, estimator, rows);
            const Rendered all = render(scene, pattern, box, estimator, rows, true);
            CHECK(all.samples_evaluated == all.samples_total);
            CHECK(some.samples_total == all.samples_total);
            CHECK(some.samples_evaluated <= std::int64_t{pattern.n()} * static_cast<std::int64_t>(some.value.size()));
            int different = 0;
            std::size_t index = 0;
            for_each_rendered(rows, all, [&](int, int, Cover cover, double value) {
              const double flat = cover == Cover::all ? 1.0 : 0.0;
              different += !same_bits(value, is_rendered(some.pixels, cover) ? some.value[index++] : flat);
            });
            CHECK(different == 0);
          }
        }
      }
    }
  }
}
