// The scene `disks`: the union of its disks in every answer, and what lists it refuses.
#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "core/error.h"
#include "disk_sets.h"
#include "scenes.h"

using namespace moire;
using namespace moire::test;

namespace {

std::string refusal(const Value& v) {
  Value at = v;
  at.place = "s.toml:4:9";
  try {
    const TestImage image(find_testimage("disks", ""), {{"disks", at}}, {8, 8}, "test");
  } catch (const Error& e) {
    return e.what();
  }
  return {};
}

std::string refusal(std::vector<double> circles) { return refusal(scenes::rows(std::move(circles), 3)); }

bool says(const std::string& message, const std::string& part) { return message.find(part) != std::string::npos; }

// The points of one pixel.
struct Points {
  std::vector<double> x, y;
};
Points random_points(Random& random, std::size_t n) {
  Points p;
  for (std::size_t i = 0; i < n; ++i) {
    p.x.push_back(random.uniform(0, 1));
    p.y.push_back(random.uniform(0, 1));
  }
  return p;
}

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("a point is inside where it is inside one of the disks, also in pixels of very many") {
    Random random(11);
    // 700 disks over 64 x 64 pixels, over one pixel, and in clusters.
    for (const double side : {64.0, 1.0}) {
      for (const double depth : {0.0, 0.97}) {
        CAPTURE(side);
        CAPTURE(depth);
        const std::vector<GivenCircle> circles = random_disks(random, 700, side, depth, 0.9);
        const TestImage scene = scenes::disks(rows_of(circles));
        std::vector<TestImage> single;
        for (const GivenCircle& c : circles) single.push_back(scenes::disk(c.center, c.radius));
        int wrong = 0, inside = 0;
        for (int i = 0; i < 40; ++i) {
          const Pixel pixel{static_cast<std::int64_t>(random.uniform(0, side)),
                            static_cast<std::int64_t>(random.uniform(0, side))};
          const std::size_t n = i % 2 == 0 ? 1 : 50;
          const Points p = random_points(random, n);
          std::vector<std::uint8_t> got(n), want(n), one(n);
          scene.contains({&pixel, 1}, p.x, p.y, got);
          for (const TestImage& s : single) {
            s.contains({&pixel, 1}, p.x, p.y, one);
            for (std::size_t k = 0; k < n; ++k) want[k] |= one[k];
          }
          wrong += got != want;
          for (const std::uint8_t v : got) inside += v;
        }
        CHECK(wrong == 0);
        CHECK(inside > 0);
      }
    }
  }

  TEST_CASE("a rectangle is clear of all disks, in one of them, or neither: as the disks say one by one") {
    Random random(12);
    for (const double depth : {0.0, 0.97}) {
      const std::vector<GivenCircle> circles = random_disks(random, 300, 64, depth, 0.9);
      const TestImage scene = scenes::disks(rows_of(circles));
      std::vector<TestImage> single;
      for (const GivenCircle& c : circles) single.push_back(scenes::disk(c.center, c.radius));
      int wrong = 0, count[3] = {};
      for (int i = 0; i < 3000; ++i) {
        const Pixel pixel{static_cast<std::int64_t>(random.uniform(0, 64)),
                          static_cast<std::int64_t>(random.uniform(0, 64))};
        const Vec2 lo{random.uniform(0, 1), random.uniform(0, 1)};
        const Rect r{lo, {lo.x + random.log_uniform(1e-3, 100), lo.y + random.log_uniform(1e-3, 100)}};
        Cover want = Cover::none;
        for (const TestImage& s : single) {
          if (want == Cover::none) want = s.cover(pixel, r);
        }
        wrong += scene.cover(pixel, r) != want;
        ++count[static_cast<int>(want)];
      }
      CHECK(wrong == 0);
      for (const int c : count) CHECK(c > 0);
    }
  }

  TEST_CASE("cover is sharp in the gap between disks and on tangents") {
    const TestImage scene = scenes::disks({10, 10, 5, 20, 10, 5, 15, 12, 0.25});  // the first two touch in (15, 10)
    CHECK(scene.cover({15, 10}, {{0, 0}, {0, 0}}) == Cover::partial);
    CHECK(scene.cover({15, 5}, {{-0.1, 0}, {0.1, 4}}) == Cover::none);
    CHECK(scene.cover({15, 11}, {{0, 0}, {0, 0.75}}) == Cover::partial);
    CHECK(scene.cover({15, 11}, {{0, 0}, {0, 0.75 - 1e-9}}) == Cover::none);
    CHECK(scene.cover({7, 7}, {{0, 0}, {6, 6}}) == Cover::all);
    CHECK(scene.cover({17, 7}, {{0, 0}, {6, 6}}) == Cover::all);
    CHECK(scene.cover({0, 0}, {{0, 0}, {64, 64}}) == Cover::partial);
    CHECK(scene.cover({30, 0}, {{0, 0}, {1e6, 1e6}}) == Cover::none);
  }

  TEST_CASE("the boundary holds the circles of the disks that meet the window, and no others") {
    const TestImage scene = scenes::disks({10, 10, 5, 20, 10, 5, 15, 12, 0.25, 40, 40, 1e-6});
    const auto circles = [&](Pixel p, double half_width) {
      Boundary boundary;
      scene.boundary(p, half_width, boundary);
      CHECK(boundary.segments.empty());
      CHECK(boundary.area_error == 0);
      return boundary.circles.size();
    };
    CHECK(circles({15, 7}, 0.5) == 1);
    CHECK(circles({14, 7}, 1) == 2);
    CHECK(circles({14, 11}, 2) == 3);
    CHECK(circles({14, 9}, 0.5) == 2);  // the corner (15, 10) is where they touch
    CHECK(circles({30, 30}, 3) == 0);
    CHECK(circles({39, 39}, 0.5) == 1);  // a speck on the corner
    CHECK(circles({0, 0}, 1000) == 4);
  }

  TEST_CASE("the stored doubles are the list as it was given") {
    Random random(13);
    const std::vector<double> rows = rows_of(random_disks(random, 100, 64, 0.5, 0.9));
    const StoredDoubles stored = scenes::disks(rows).stored();
    REQUIRE(stored.size() == 1);
    CHECK(stored[0].first == "disks");
    CHECK(stored[0].second == rows);
  }

  TEST_CASE("overlapping disks are refused with their numbers, counted from 0") {
    const std::string message = refusal({40, 40, 1, 10, 10, 5, 30, 10, 1, 17, 10, 2.5});
    CHECK(message ==
          "s.toml:4:9: disks[1] and disks[3] (counted from 0) overlap by 0.5 pixels: [10, 10, 5] and [17, 10, 2.5]; "
          "disks may touch, not more");
    CHECK(says(refusal({1, 1, 5, 1.5, 1, 0.25}),
               "disks[0] and disks[1] (counted from 0) overlap by 4.75 pixels"));  // one within the other
    CHECK(says(refusal({1, 1, 5, 1, 1, 5}), "overlap by 10 pixels: [1, 1, 5] and [1, 1, 5]"));
  }

  TEST_CASE("disks that touch are accepted, and refused from the next double on") {
    CHECK(refusal({0, 0, 1, 2, 0, 1}) == "");
    CHECK(refusal({0, 0, 1, std::nextafter(2.0, 3.0), 0, 1}) == "");
    CHECK(says(refusal({0, 0, 1, std::nextafter(2.0, 0.0), 0, 1}), "overlap by 2.22e-16 pixels"));
    CHECK(refusal({16, 14, 13, 25, 26, 2}) == "");
    CHECK(says(refusal({16, 14, 13, 25, 26, std::nextafter(2.0, 3.0)}), "overlap by 4.44e-16 pixels"));
    CHECK(says(refusal({16, 14, std::nextafter(13.0, 14.0), 25, 26, 2}), "overlap by 1.78e-15 pixels"));
    CHECK(refusal({16, 14, std::nextafter(13.0, 0.0), 25, 26, 2}) == "");
    // Rounded to double both sums of radii are 1.
    CHECK(says(refusal({0, 0, 1, 1, 0, 1e-17}), "overlap by 1e-17 pixels"));
    CHECK(refusal({0, 0, 1, 1 + 0x1p-52, 0, 1e-17}) == "");
    CHECK(refusal({-1e15, 0, 1e15, 1e-6, 0, 1e-6}) == "");
    CHECK(says(refusal({-1e15, 0, 1e15, 1e-6, 0, 1.01e-6}), "overlap by 1e-08 pixels"));
  }

  TEST_CASE("lists that are no lists of disks are refused, and numbers out of range with their place in the list") {
    CHECK(says(refusal(scenes::list({})), "\"disks\" is empty"));
    CHECK(says(refusal(scenes::list({1, 2, 3})), "[[x, y, radius], ...]"));
    CHECK(says(refusal(scenes::one(3)), "[[x, y, radius], ...]"));
    CHECK(says(refusal(scenes::rows({1, 2, 3, 4}, 2)), "[[x, y, radius], ...]"));
    CHECK(says(refusal(scenes::rows({1, 2, 3, 4}, 4)), "[[x, y, radius], ...]"));
    CHECK(says(refusal({1, 2, 3, 10, 2, 0}), "\"radius of disks[1]\" is 0; it must be at least 1e-100 pixels"));
    CHECK(says(refusal({1, 2, -3}), "\"radius of disks[0]\" is -3"));
    CHECK(says(refusal({1, 2, 3, 10, 2, 1e-101}), "\"radius of disks[1]\""));
    CHECK(says(refusal({1, 2, 3, 10, 2, 2e15}), "\"radius of disks[1]\" is 2e+15; at most 1e+15"));
    CHECK(says(refusal({1, 2, 3, 2e15, 2, 1}), "\"disks[1]\" is 2e+15; at most 1e+15"));
    CHECK(says(refusal({1, 2, 3, 9, -2e15, 1}), "\"disks[1]\" is -2e+15; at most 1e+15"));
    CHECK(says(refusal({1, 2, std::numeric_limits<double>::quiet_NaN()}), "not finite"));
  }
}
