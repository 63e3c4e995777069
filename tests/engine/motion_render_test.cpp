// What the renderer makes of moving scenes.
#include <doctest/doctest.h>

#include <bit>
#include <cmath>
#include <string>
#include <vector>

#include "engine/exact.h"
#include "engine/render.h"
#include "moving_scenes.h"

namespace moire {

TEST_SUITE("unit") {
  TEST_CASE("a moving scene renders the same bits with skipping and without, and its error is that of its samples") {
    const Grid grid{24, 20};
    const std::vector<TestImage> scenes{scenes::moving_edge({11.3, 9.7}, {0.3, 1}, {2, 3.5}, grid),
                                        scenes::moving_disk({9, 8}, 4.25, {6.5, 3}, grid),
                                        scenes::moving_disks({5, 5, 2, 12, 8, 3, 20, 15, 0.1}, {1.5, -2}, grid)};
    int patterns_with_time = 0;
    for (const PatternInfo* info : patterns()) {
      if (!info->has_time) continue;
      ++patterns_with_time;
      CAPTURE(std::string(info->name));
      const Pattern pattern(PatternChoice(parse_spec(info->name, "test")), 16, {.seed = 3, .trial = 0});
      for (const TestImage& scene : scenes) {
        for (const char* text : {"box", "mitchell", "box:width=0.5"}) {
          const Filter filter(parse_spec(text, "test"));
          const ActiveRows rows = enumerate(scene, filter.radius());
          const Reference reference = exact(scene, filter, rows);
          for (const std::string_view name : estimator_names()) {
            const Estimator estimator = find_estimator(name, "test");
            const Rendered some = render(scene, pattern, filter, estimator, rows);
            const Rendered all = render(scene, pattern, filter, estimator, rows, true);
            std::size_t index = 0;
            int different = 0;
            for_each_rendered(rows, all, [&](int, int, Cover cover, double value) {
              const double flat = cover == Cover::all ? 1.0 : 0.0;
              const double want = is_rendered(some.pixels, cover) ? some.value[index++] : flat;
              different += std::bit_cast<std::uint64_t>(value) != std::bit_cast<std::uint64_t>(want);
            });
            CHECK(different == 0);
            CHECK(some.fallbacks == all.fallbacks);
            if (estimator != Estimator::ratio || text != std::string("box")) continue;
            double squares = 0;
            for (std::size_t i = 0; i < some.value.size(); ++i) {
              squares += (some.value[i] - reference.value[i]) * (some.value[i] - reference.value[i]);
            }
            // Below independent samples' 1 / (2 sqrt(16)), and far from none.
            const double rms = std::sqrt(squares / static_cast<double>(some.value.size()));
            CHECK(rms < 0.14);
            CHECK(rms > 0.005);
          }
        }
      }
    }
    CHECK(patterns_with_time >= 2);
  }
}

}  // namespace moire
