// Sums over points of products of two tables, every row with every column: the inner loop of spectra of point sets. A
// real matrix product, blocked for registers; each sum runs over the points in their order, so that its bits do not
// depend on the width of the machine's vectors.
#pragma once

#include <cstddef>
#include <span>

namespace moire {

// Entries that stand together in the tables, and the size of a tile.
inline constexpr std::size_t kTileRows = 4, kTileColumns = 8;

// One tile: sums[r][c] = sum over i < points of rows[i][r] * columns[i][c], with rows[i] kTileRows and columns[i]
// kTileColumns numbers; the three arrays do not overlap.
using TileKernel = void (*)(std::size_t points, const double* rows, const double* columns, double* sums);

// The kernels that this machine can run, the fastest last; all give the same bits.
std::span<const TileKernel> tile_kernels();

}  // namespace moire
