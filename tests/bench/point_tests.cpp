// Point tests of scenes, 1024 points at a time: in pixels that the boundary crosses, and in pixels far from it.
#include <benchmark/benchmark.h>

#include <cstdint>
#include <vector>

#include "bench/bench_points.h"
#include "scenes.h"

namespace moire {
namespace {

void point_tests(benchmark::State& state, const TestImage& scene, Pixel first) {
  const Pattern pattern = bench::pattern_of("random", 64);
  const bench::RunPoints run(pattern, 16, first);
  std::vector<std::uint8_t> inside(run.x.size());
  for (auto _ : state) {
    scene.contains(run.pixels, run.x, run.y, inside);
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(run.x.size()));
}

const Grid kGrid{512, 512};
const TestImage kEdge = scenes::edge({256.3, 256.1}, 83.0, kGrid);
const TestImage kDisk = scenes::disk({256.2, 255.7}, 200.25, kGrid);
const TestImage kField = scenes::usual_noise_field(1, kGrid);
const TestImage kBoard =
    scenes::plane({.focal = 512, .principal = {256, 160}, .height = 1.5, .pitch = 18, .yaw = 11, .roll = 0}, kGrid);

BENCHMARK_CAPTURE(point_tests, edge_crossed, kEdge, Pixel{248, 256});
BENCHMARK_CAPTURE(point_tests, edge_far, kEdge, Pixel{248, 20});
BENCHMARK_CAPTURE(point_tests, disk_crossed, kDisk, Pixel{248, 55});
BENCHMARK_CAPTURE(point_tests, disk_far, kDisk, Pixel{248, 256});
BENCHMARK_CAPTURE(point_tests, noise_field, kField, Pixel{248, 256});
BENCHMARK_CAPTURE(point_tests, board_near, kBoard, Pixel{248, 500});
BENCHMARK_CAPTURE(point_tests, board_horizon, kBoard, Pixel{248, 4});

}  // namespace
}  // namespace moire
