// The hash: words per second, one key, many indices, as the loops of the random patterns use it.
#include "core/hash.h"

#include <benchmark/benchmark.h>

#include <cstdint>
#include <vector>

namespace moire {
namespace {

void hash_words(benchmark::State& state) {
  const Key key = pixel_key(draw_hash(1, 0), {3, 5});
  std::vector<std::uint32_t> a(1024), b(1024), c(1024), d(1024);
  for (auto _ : state) {
    for (std::uint32_t i = 0; i < 1024; ++i) {
      const Words w = hash(key, i, Axis::xy);
      a[i] = w.a;
      b[i] = w.b;
      c[i] = w.c;
      d[i] = w.d;
    }
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(state.iterations() * 1024);  // four words each: two coordinates
}
BENCHMARK(hash_words);

void pixel_keys(benchmark::State& state) {
  std::vector<Key> keys(1024);
  for (auto _ : state) {
    for (std::int64_t i = 0; i < 1024; ++i) keys[static_cast<std::size_t>(i)] = pixel_key(7, {i, 5});
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(state.iterations() * 1024);
}
BENCHMARK(pixel_keys);

}  // namespace
}  // namespace moire
