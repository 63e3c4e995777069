// Pair sums of the edge discrepancy, on one thread: quadratic in the points.
#include "measure/discrepancy/edge_l2.h"

#include <benchmark/benchmark.h>

#include "bench/bench_points.h"
#include "core/parallel.h"

namespace moire {
namespace {

void edge_l2(benchmark::State& state, LineLaw law) {
  const ThreadLimit one(1);
  const bench::RunPoints points(bench::pattern_of("random", static_cast<int>(state.range(0))), 1);
  for (auto _ : state) benchmark::DoNotOptimize(edge_l2_squared({points.x, points.y}, law));
  state.SetItemsProcessed(state.iterations() * state.range(0) * (state.range(0) - 1) / 2);  // pairs
  state.SetComplexityN(state.range(0));
}

BENCHMARK_CAPTURE(edge_l2, isotropic, LineLaw::isotropic)->RangeMultiplier(4)->Range(16, 4096)->Complexity();
BENCHMARK_CAPTURE(edge_l2, printed, LineLaw::printed)->RangeMultiplier(4)->Range(16, 4096)->Complexity();

}  // namespace
}  // namespace moire
