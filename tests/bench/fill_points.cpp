// Filling of runs of pixels, about 1024 points at a time as the renderer asks for them. Items are points.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <string>

#include "bench/bench_points.h"

namespace moire {
namespace {

void fill_points(benchmark::State& state, const std::string& text) {
  const auto n = static_cast<int>(state.range(0));
  const Pattern pattern = bench::pattern_of(text, n);
  bench::RunPoints run(pattern, std::max(1, 1024 / n));
  for (auto _ : state) {
    pattern.fill(run.pixels, {run.x, run.y});
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(run.x.size()));
}

// Every pattern of the catalogue that may have 1, 16, 256 and 4096 points.
const bool kRegistered = [] {
  for (const PatternInfo* info : patterns()) {
    auto* benchmark = benchmark::RegisterBenchmark(
        ("fill/" + std::string(info->name)).c_str(),
        [name = std::string(info->name)](benchmark::State& state) { fill_points(state, name); });
    for (const int n : {1, 16, 256, 4096}) benchmark->Arg(n);
  }
  return true;
}();

}  // namespace
}  // namespace moire
