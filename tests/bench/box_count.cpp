// Pixels at the boundary under the unit box: all samples made and tested, or the pattern's cells sorted first and only
// crossed ones tested. Items are pixels. Where the second way is the faster one on edge and disk says how many samples
// HasCells should ask for (kLeastForCells).
#include <benchmark/benchmark.h>

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "bench/bench_points.h"
#include "engine/active_rows.h"
#include "engine/box_count.h"
#include "scenes.h"

namespace moire {
namespace {

constexpr Grid kGrid{512, 512};

enum class Way : std::uint8_t { all, cells };

void count_pixels(benchmark::State& state, const TestImage& scene, const std::string& text, Way way) {
  const auto n = static_cast<int>(state.range(0));
  const Pattern pattern = bench::pattern_of(text, n);
  std::vector<Pixel> pixels;
  const ActiveRows rows = enumerate(scene, 0.5);
  for (int y = 0; y < kGrid.height; ++y) {
    for (const Run& run : rows.row(y)) {
      for (int x = run.x0; run.cover == Cover::partial && x < run.x1; ++x) pixels.push_back({x, y});
    }
  }
  // Sets of a bank are made and sorted when a pixel first takes them: the first visits are not timed.
  BoxCounter counter(scene, pattern);
  std::int64_t inside;
  for (const Pixel& p : pixels) {
    if (counter.has_cells()) counter.test_crossed(p);
    counter.test_all(static_cast<int>(p.x), static_cast<int>(p.x) + 1, static_cast<int>(p.y), {&inside, 1});
  }
  if (way == Way::cells && !counter.has_cells()) return state.SkipWithError("no cells");
  std::int64_t tested = 0;
  for (auto _ : state) {
    for (const Pixel& p : pixels) {
      if (way == Way::cells) {
        tested += counter.test_crossed(p).tested;
      } else {
        counter.test_all(static_cast<int>(p.x), static_cast<int>(p.x) + 1, static_cast<int>(p.y), {&inside, 1});
        benchmark::DoNotOptimize(inside);
        tested += n;
      }
    }
  }
  const auto visited = static_cast<double>(state.iterations()) * static_cast<double>(pixels.size());
  state.SetItemsProcessed(static_cast<std::int64_t>(visited));
  state.counters["tested"] = static_cast<double>(tested) / visited;
}

const TestImage kEdge = scenes::edge({256.3, 256.1}, 83.0, kGrid);
const TestImage kDisk = scenes::disk({256.2, 255.7}, 200.25, kGrid);
const TestImage kBoard = scenes::board(
    {.focal = 512, .principal = {256, 160}, .height = 1.5, .pitch = 30, .yaw = 11, .roll = 0}, {-4, 4, 1, 9}, kGrid);
const TestImage kField = scenes::usual_noise_field(1, kGrid);

const bool kRegistered = [] {
  const std::pair<const char*, const TestImage*> kScenes[] = {
      {"edge", &kEdge}, {"disk", &kDisk}, {"board", &kBoard}, {"noise_field", &kField}};
  for (const char* text : {"jittered", "scan-time", "regular", "hammersley", "hammersley:instance=shift",
                           "hammersley:instance=scramble", "dart-throwing:bank=4"}) {
    for (const auto& [scene_name, scene] : kScenes) {
      for (const Way way : {Way::all, Way::cells}) {
        const std::string name = std::string("box/") + text + '/' + scene_name + (way == Way::all ? "/all" : "/cells");
        auto* benchmark = benchmark::RegisterBenchmark(
            name.c_str(), [s = scene, way, text](benchmark::State& state) { count_pixels(state, *s, text, way); });
        for (const int n : {64, 100, 256, 576, 1024, 4096}) benchmark->Arg(n);
      }
    }
  }
  return true;
}();

}  // namespace
}  // namespace moire
