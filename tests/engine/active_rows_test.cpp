// Active rows against the definition, pixel by pixel; and their cost.
#include <doctest/doctest.h>

#include "catalogue.h"
#include "engine/active_rows.h"

using namespace moire;
using namespace moire::test;

TEST_SUITE("unit") {
  TEST_CASE("runs cover each row without gaps, neighbours differ, and each pixel has the class of its own window") {
    for (const auto& [name, scene] : scene_catalogue({61, 47})) {
      for (const Filter& filter : filter_catalogue()) {
        CAPTURE(name);
        CAPTURE(filter.text());
        const ActiveRows rows = enumerate(scene, filter.radius());
        std::int64_t active = 0;
        int wrong = 0;
        for (int y = 0; y < 47; ++y) {
          CHECK(rows.first_active(y) == active);
          int x = 0;
          Cover last = Cover::none;
          for (const Run& r : rows.row(y)) {
            CHECK(r.x0 == x);
            CHECK(r.x1 > r.x0);
            if (x > 0) CHECK(r.cover != last);
            last = r.cover;
            for (; x < r.x1; ++x) wrong += classify(scene, filter.radius(), {x, y}) != r.cover;
            if (r.cover == Cover::partial) active += r.x1 - r.x0;
          }
          CHECK(x == 61);
        }
        CHECK(wrong == 0);
        CHECK(rows.active_pixels() == active);
        std::int64_t counted = 0;
        for_each_active(rows, [&](int, int, std::int64_t index) { CHECK(index == counted++); });
        CHECK(counted == active);
      }
    }
  }

  TEST_CASE("an inactive window holds no boundary: its corners, sides and inside agree with its class") {
    for (const auto& [name, scene] : scene_catalogue()) {
      const Filter tent(parse_spec("tent", "test"));
      const ActiveRows rows = enumerate(scene, tent.radius());
      int wrong = 0;
      for (int y = 0; y < rows.grid().height; ++y) {
        for (const Run& r : rows.row(y)) {
          if (r.cover == Cover::partial) continue;
          for (int x = r.x0; x < r.x1; ++x) {
            const Pixel p{x, y};
            for (double dx = -0.5; dx <= 1.5; dx += 0.25) {
              for (double dy = -0.5; dy <= 1.5; dy += 0.25) {
                std::uint8_t in = 0;
                scene.contains({&p, 1}, {&dx, 1}, {&dy, 1}, {&in, 1});
                wrong += (in == 1) != (r.cover == Cover::all);
              }
            }
          }
        }
      }
      CAPTURE(name);
      CHECK(wrong == 0);
    }
  }

  TEST_CASE("touching counts: an edge along a pixel side makes the pixels on both sides active, and no others") {
    const ActiveRows rows = enumerate(scenes::edge({256, 0}, 180, {512, 3}), 0.5);
    for (int y = 0; y < 3; ++y) {
      REQUIRE(rows.row(y).size() == 3);
      CHECK(rows.row(y)[1].x0 == 255);
      CHECK(rows.row(y)[1].x1 == 257);
      CHECK(rows.row(y)[0].cover == Cover::all);
      CHECK(rows.row(y)[2].cover == Cover::none);
    }
  }

  TEST_CASE("the largest image has rows in proportion to its boundary") {
    // 2^20 x 2^20 pixels: nothing that visits pixels would end.
    const ActiveRows rows = enumerate(scenes::disk({500000.3, 500000.7}, 3, {kMaxSide, kMaxSide}), 2);
    CHECK(rows.active_pixels() > 0);
    CHECK(rows.active_pixels() < 200);
  }
}
