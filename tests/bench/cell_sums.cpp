// Sums over one cell for all pixels around it that its samples weigh in. Items are samples.
#include "engine/cell_sums.h"

#include <benchmark/benchmark.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "bench/bench_points.h"
#include "filters/filter.h"

namespace moire {
namespace {

// Cells take turns, so that no weights are remembered from the cell before.
void cell_sums(benchmark::State& state, const std::string& text) {
  const Filter filter(parse_spec(text, "bench"));
  const auto n = static_cast<std::size_t>(state.range(0));
  const bench::RunPoints run(bench::pattern_of("random", static_cast<int>(n)), 8);
  const auto side = static_cast<std::size_t>(2 * filter.apron() + 1);
  const std::vector<std::uint8_t> inside(n, 1), needed(side * side, 1);
  std::vector<WeightSum> sums(side * side);
  OwnCount own;
  CellSums sum(filter);
  std::size_t cell = 0;
  for (auto _ : state) {
    const std::span<const double> x(run.x.data() + cell * n, n), y(run.y.data() + cell * n, n);
    sum(x, y, inside, needed, sums, own);
    benchmark::ClobberMemory();
    cell = (cell + 1) % 8;
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(n));
}

BENCHMARK_CAPTURE(cell_sums, box, "box")->Arg(1)->Arg(16)->Arg(256);
BENCHMARK_CAPTURE(cell_sums, tent, "tent")->Arg(1)->Arg(16)->Arg(256);
BENCHMARK_CAPTURE(cell_sums, mitchell, "mitchell")->Arg(1)->Arg(16)->Arg(256);
BENCHMARK_CAPTURE(cell_sums, lanczos, "lanczos")->Arg(1)->Arg(16)->Arg(256);
BENCHMARK_CAPTURE(cell_sums, cone, "cone")->Arg(1)->Arg(16)->Arg(256);
BENCHMARK_CAPTURE(cell_sums, jinc, "jinc")->Arg(1)->Arg(16)->Arg(256);

}  // namespace
}  // namespace moire
