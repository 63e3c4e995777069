// Active pixels and exact values of whole images by kind of scene, on one thread. Items are active pixels.
#include <benchmark/benchmark.h>

#include <string>

#include "core/parallel.h"
#include "engine/active_rows.h"
#include "engine/exact.h"
#include "scenes.h"

namespace moire {
namespace {

void exact_pixels(benchmark::State& state, const TestImage& scene, const std::string& text) {
  const ThreadLimit one(1);
  const Filter filter(parse_spec(text, "bench"));
  const ActiveRows rows = enumerate(scene, filter.radius());
  for (auto _ : state) benchmark::DoNotOptimize(exact(scene, filter, rows));
  state.SetItemsProcessed(state.iterations() * rows.active_pixels());
}

void active_rows(benchmark::State& state, const TestImage& scene) {
  for (auto _ : state) benchmark::DoNotOptimize(enumerate(scene, 0.5));
  state.SetItemsProcessed(state.iterations() * enumerate(scene, 0.5).active_pixels());
}

const Grid kGrid{512, 512};
const TestImage kEdge = scenes::edge({256.3, 256.1}, 83.0, kGrid);
const TestImage kDisk = scenes::disk({256.2, 255.7}, 200.25, kGrid);
const TestImage kField = scenes::usual_noise_field(1, {64, 64});
const TestImage kBoard =
    scenes::board({.focal = 512, .principal = {256, 160}, .height = 1.5, .pitch = 18, .yaw = 11, .roll = 0},
                  {-20, 20, 0, 200}, kGrid);
const TestImage kPlane = scenes::plane(
    {.focal = 512, .principal = {256, 160}, .height = 1.5, .pitch = 18, .yaw = 11, .roll = 0}, {128, 128});

BENCHMARK_CAPTURE(exact_pixels, edge_box, kEdge, "box")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(exact_pixels, edge_mitchell, kEdge, "mitchell")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(exact_pixels, disk_box, kDisk, "box")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(exact_pixels, disk_mitchell, kDisk, "mitchell")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(exact_pixels, noise_field_box, kField, "box")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(exact_pixels, board_box, kBoard, "box")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(exact_pixels, board_mitchell, kBoard, "mitchell")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(exact_pixels, horizon_box, kPlane, "box")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(active_rows, edge, kEdge)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(active_rows, disk, kDisk)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(active_rows, board, kBoard)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace moire
