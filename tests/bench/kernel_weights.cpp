// Weights of filters at 1024 places of their support. Items are weights.
#include <benchmark/benchmark.h>

#include <cstdint>
#include <string>
#include <vector>

#include "core/hash.h"
#include "filters/filter.h"

namespace moire {
namespace {

void kernel_weights(benchmark::State& state, const std::string& text) {
  const Filter filter(parse_spec(text, "bench"));
  const double radius = filter.radius();
  std::vector<double> x(1024), weight(1024);
  const Key key = pixel_key(draw_hash(1, 0), {});
  for (std::uint32_t i = 0; i < 1024; ++i) {
    const Words w = hash(key, i, Axis::xy);
    x[i] = (unit(w.a, w.b) * 2 - 1) * radius;
  }
  for (auto _ : state) {
    filter.kernel().weights(x, weight);
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(state.iterations() * 1024);
}

BENCHMARK_CAPTURE(kernel_weights, box, "box");
BENCHMARK_CAPTURE(kernel_weights, tent, "tent");
BENCHMARK_CAPTURE(kernel_weights, mitchell, "mitchell");
BENCHMARK_CAPTURE(kernel_weights, gaussian, "gaussian");
BENCHMARK_CAPTURE(kernel_weights, lanczos, "lanczos");
BENCHMARK_CAPTURE(kernel_weights, blackman_harris, "blackman-harris");

}  // namespace
}  // namespace moire
