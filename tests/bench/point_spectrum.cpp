// Spectra of sets of points, on one thread. Items are products of a point and a frequency.
#include "measure/point_spectrum.h"

#include <benchmark/benchmark.h>

#include "bench/bench_points.h"
#include "core/parallel.h"

namespace moire {
namespace {

void point_spectrum(benchmark::State& state) {
  const ThreadLimit one(1);
  const bench::RunPoints points(bench::pattern_of("random", static_cast<int>(state.range(0))), 1);
  PointSpectrum spectrum(static_cast<int>(state.range(1)));
  for (auto _ : state) spectrum.add(points.x, points.y);
  state.SetItemsProcessed(state.iterations() * state.range(0) * state.range(1) * state.range(1));
}

BENCHMARK(point_spectrum)->Args({256, 128})->Args({1600, 128})->Args({1600, 512})->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace moire
