// The L2 star discrepancy in the square and the cube: N log N and N log^2 N.
#include "measure/discrepancy/star_l2.h"

#include <benchmark/benchmark.h>

#include <vector>

#include "bench/bench_points.h"

namespace moire {
namespace {

void star_l2(benchmark::State& state, int dims) {
  const auto n = static_cast<std::size_t>(state.range(0));
  const Pattern pattern = bench::pattern_of("random", static_cast<int>(n));
  std::vector<double> x(n), y(n), t(dims == 3 ? n : 0);
  pattern.fill_set({x, y, t});
  for (auto _ : state) benchmark::DoNotOptimize(star_l2_squared({x, y, t}));
  state.SetItemsProcessed(state.iterations() * state.range(0));
  state.SetComplexityN(state.range(0));
}

BENCHMARK_CAPTURE(star_l2, square, 2)->RangeMultiplier(4)->Range(16, 65536)->Complexity(benchmark::oNLogN);
BENCHMARK_CAPTURE(star_l2, cube, 3)->RangeMultiplier(4)->Range(16, 4096)->Complexity(benchmark::oNLogN);

}  // namespace
}  // namespace moire
