// Sums over points of products of two tables.
#include "measure/outer_sums.h"

#include <algorithm>

namespace moire {
namespace {

// kStep columns at a time, so many that the sums fit into the registers of the machine. The loops over r and c have
// constant lengths: compilers unroll them and hold `sum` in vector registers.
template <std::size_t kStep>
[[gnu::always_inline]] inline void tile(std::size_t points, const double* __restrict rows,
                                        const double* __restrict columns, double* __restrict sums) {
  for (std::size_t begin = 0; begin < kTileColumns; begin += kStep) {
    double sum[kTileRows][kStep] = {};
    for (std::size_t i = 0; i < points; ++i) {
      const double* row = rows + i * kTileRows;
      const double* column = columns + i * kTileColumns + begin;
      for (std::size_t r = 0; r < kTileRows; ++r)
        for (std::size_t c = 0; c < kStep; ++c) sum[r][c] += row[r] * column[c];
    }
    for (std::size_t r = 0; r < kTileRows; ++r) std::copy_n(sum[r], kStep, sums + r * kTileColumns + begin);
  }
}

void tile_plain(std::size_t points, const double* rows, const double* columns, double* sums) {
  tile<4>(points, rows, columns, sums);
}

#if defined(__x86_64__)
[[gnu::target("avx2")]] void tile_avx2(std::size_t points, const double* rows, const double* columns, double* sums) {
  tile<8>(points, rows, columns, sums);
}
constexpr TileKernel kKernels[] = {tile_plain, tile_avx2};
std::size_t usable() { return __builtin_cpu_supports("avx2") ? 2 : 1; }
#else
constexpr TileKernel kKernels[] = {tile_plain};
std::size_t usable() { return 1; }
#endif

}  // namespace

std::span<const TileKernel> tile_kernels() { return {kKernels, usable()}; }

}  // namespace moire
