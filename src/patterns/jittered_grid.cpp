// Points of a jittered grid: the hash of each cell, then its place. A few hundred at a time, so that they stay in the
// first cache between the two loops.
//
// ns per point, g++ 12 -O3, plain, AVX2 and AVX-512: 6.1, 3.2 and 1.5 for 16 x 16 cells, of which the hash takes nearly
// all, 7.6, 5.0 and 4.0 for 15 x 15, which must divide; some 20 cells taken singly 12, 8 and 5.
#include "patterns/jittered_grid.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "core/hash_lanes.h"
#include "core/instruction_sets.h"

namespace moire {
namespace {

constexpr int kChunk = 512;
constexpr int kWidest = 16;  // points in the widest vector: lists of cells are padded to whole ones

// Offsets of points in their cells, before they are placed; index as in fill_from_hashes().
template <std::size_t width, class Index>
[[gnu::always_inline]] inline void make_offsets(const JitteredGrid& grid, const Key& key, const Index& index, int count,
                                                double* __restrict x, double* __restrict y) noexcept {
  const Strata across = grid.across, down = grid.down;
  const auto block = [=]<class Lanes>(const typename Lanes::Pair& pair, std::size_t, double* to_x, double* to_y)
      __attribute__((always_inline)) {
    for (std::size_t half = 0; half < 2; ++half) {
      typename Lanes::Bits u = pair.x[half] >> 12, v = pair.y[half] >> 12;
      across.one_plus_offset(u);
      down.one_plus_offset(v);
      const auto left = reinterpret_cast<typename Lanes::Real>(u) - 1.0,
                 above = reinterpret_cast<typename Lanes::Real>(v) - 1.0;
      std::memcpy(to_x + half * Lanes::kHalf, &left, sizeof left);
      std::memcpy(to_y + half * Lanes::kHalf, &above, sizeof above);
    }
  };
  fill_from_hashes<width>(key, Axis::xy, 0, static_cast<std::size_t>(count), index, block, x, y);
  const double amount = grid.amount;
  if (amount == 1) return;  // where jitter() changes nothing
  for (int i = 0; i < count; ++i) {
    x[i] = 0.5 + amount * (x[i] - 0.5);
    y[i] = 0.5 + amount * (y[i] - 0.5);
  }
}

// offset[i] becomes the coordinate in stratum cell(i).
template <class Cell>
[[gnu::always_inline]] inline void place(const Strata& strata, const Cell& cell, int count,
                                         double* __restrict offset) noexcept {
  if (strata.has_exact_width()) {
    const double width = strata.width();
    for (int i = 0; i < count; ++i) offset[i] = (cell(i) + offset[i]) * width;
  } else {
    const Strata s = strata;
    for (int i = 0; i < count; ++i) offset[i] = s.place(cell(i), offset[i]);
  }
}

// The points of a grid with powers of two of columns and rows and all of the jitter, the usual one, at once. What comes
// from the hash is 1 + offset, and 1 less than the cell's number is added: exact, since cell + offset is. Blocks begin
// at multiples of their width, so that their first cell is in column 0 or they are in one row.
template <std::size_t width>
[[gnu::always_inline]] inline void fill_binary(const JitteredGrid& grid, const Key& key, double* __restrict x,
                                               double* __restrict y) noexcept {
  const Strata across = grid.across, down = grid.down;
  const double cell_width = across.width(), cell_height = down.width();
  const auto last = static_cast<std::uint64_t>(grid.columns - 1);
  const auto digits = static_cast<int>(std::bit_width(last));
  const auto block = [&]<class Lanes>(const typename Lanes::Pair& pair, std::size_t i, double* to_x, double* to_y)
      __attribute__((always_inline)) {
    using Real = typename Lanes::Real;
    // Numbers below 2^52 in the fraction of 2^52.
    const double first_column = static_cast<double>(i & last) - (0x1p52 + 1),
                 first_row = static_cast<double>(i >> digits) - (0x1p52 + 1);
    for (std::size_t half = 0; half < 2; ++half) {
      const std::size_t at = half * Lanes::kHalf;
      typename Lanes::Bits u = pair.x[half] >> 12, v = pair.y[half] >> 12, cell;
      across.one_plus_offset(u);
      down.one_plus_offset(v);
      Lanes::count_up_from(at, cell);
      const typename Lanes::Bits column = (cell & last) | 0x4330000000000000u,
                                 row = (cell >> digits) | 0x4330000000000000u;
      const Real left = (reinterpret_cast<Real>(u) + (reinterpret_cast<Real>(column) + first_column)) * cell_width,
                 above = (reinterpret_cast<Real>(v) + (reinterpret_cast<Real>(row) + first_row)) * cell_height;
      std::memcpy(to_x + at, &left, sizeof left);
      std::memcpy(to_y + at, &above, sizeof above);
    }
  };
  fill_from_hashes<width>(key, Axis::xy, 0,
                          static_cast<std::size_t>(grid.columns) * static_cast<std::size_t>(grid.rows),
                          ConsecutiveIndices{0}, block, x, y);
}

// Whole rows at a time; of long rows, parts.
template <std::size_t width>
[[gnu::always_inline]] inline void fill_grid(const JitteredGrid& grid, const Key& key, double* x, double* y) noexcept {
  if (grid.amount == 1 && grid.across.has_exact_width() && grid.down.has_exact_width()) {
    return fill_binary<width>(grid, key, x, y);
  }
  const int columns = grid.columns, n = columns * grid.rows;
  const int together = columns < kChunk ? kChunk / columns * columns : kChunk;
  int row = 0, column = 0;
  for (int done = 0; done < n;) {
    const int count = columns < kChunk ? std::min(together, n - done) : std::min(kChunk, columns - column);
    make_offsets<width>(grid, key, ConsecutiveIndices{static_cast<std::uint32_t>(done)}, count, x, y);
    if (grid.across.has_exact_width()) {  // a power of two of columns: no need to go row by row
      const int first = done, last = columns - 1,
                digits = static_cast<int>(std::bit_width(static_cast<unsigned>(last)));
      place(
          grid.across, [=](int i) { return static_cast<double>((first + i) & last); }, count, x);
      place(
          grid.down, [=](int i) { return static_cast<double>((first + i) >> digits); }, count, y);
      done += count;
      x += count;
      y += count;
      continue;
    }
    for (int at = 0; at < count;) {
      const int part = std::min(count - at, columns - column), first = column, r = row;
      place(
          grid.across, [first](int i) { return static_cast<double>(first + i); }, part, x + at);
      place(
          grid.down, [r](int) { return static_cast<double>(r); }, part, y + at);
      at += part;
      column += part;
      if (column == columns) {
        column = 0;
        ++row;
      }
    }
    done += count;
    x += count;
    y += count;
  }
}

// Cells are listed first, so that those of many short spans are hashed together.
template <std::size_t width>
[[gnu::always_inline]] inline std::size_t take_grid(const JitteredGrid& grid, const Key& key,
                                                    std::span<const CellSpan> cells, double* x, double* y) noexcept {
  std::array<std::int32_t, kChunk> column, row;
  alignas(64) std::array<double, kChunk> px, py;
  const int columns = grid.columns;
  std::size_t done = 0;
  int count = 0;
  const auto flush = [&]() __attribute__((always_inline)) {
    int padded = count;
    for (; padded % kWidest != 0; ++padded) {
      column[static_cast<std::size_t>(padded)] = 0;
      row[static_cast<std::size_t>(padded)] = 0;
    }
    const std::int32_t* const c = column.data();
    const std::int32_t* const r = row.data();
    const auto index = [=]<class Lanes>(std::size_t i, typename Lanes::Word & to) __attribute__((always_inline)) {
      typename Lanes::Word in_row;
      std::memcpy(&to, r + i, sizeof to);
      std::memcpy(&in_row, c + i, sizeof in_row);
      to = to * static_cast<std::uint32_t>(columns) + in_row;
    };
    make_offsets<width>(grid, key, index, padded, px.data(), py.data());
    place(
        grid.across, [c](int i) { return static_cast<double>(c[i]); }, padded, px.data());
    place(
        grid.down, [r](int i) { return static_cast<double>(r[i]); }, padded, py.data());
    std::copy_n(px.data(), count, x + done);
    std::copy_n(py.data(), count, y + done);
    done += static_cast<std::size_t>(count);
    count = 0;
  };
  for (const CellSpan& span : cells) {
    for (std::int32_t i = span.begin; i < span.end; ++i) {
      column[static_cast<std::size_t>(count)] = i;
      row[static_cast<std::size_t>(count)] = span.row;
      if (++count == kChunk) flush();
    }
  }
  if (count > 0) flush();
  return done;
}

void fill_plain(const JitteredGrid& grid, const Key& key, double* x, double* y) noexcept {
  fill_grid<4>(grid, key, x, y);
}
std::size_t take_plain(const JitteredGrid& grid, const Key& key, std::span<const CellSpan> cells, double* x,
                       double* y) noexcept {
  return take_grid<4>(grid, key, cells, x, y);
}

#if MOIRE_HAS_AVX
[[MOIRE_AVX2]] void fill_avx2(const JitteredGrid& grid, const Key& key, double* x, double* y) noexcept {
  fill_grid<8>(grid, key, x, y);
}
[[MOIRE_AVX2]] std::size_t take_avx2(const JitteredGrid& grid, const Key& key, std::span<const CellSpan> cells,
                                     double* x, double* y) noexcept {
  return take_grid<8>(grid, key, cells, x, y);
}
[[MOIRE_AVX512]] void fill_avx512(const JitteredGrid& grid, const Key& key, double* x, double* y) noexcept {
  fill_grid<16>(grid, key, x, y);
}
[[MOIRE_AVX512]] std::size_t take_avx512(const JitteredGrid& grid, const Key& key, std::span<const CellSpan> cells,
                                         double* x, double* y) noexcept {
  return take_grid<16>(grid, key, cells, x, y);
}
constexpr JitteredKernel kKernels[] = {{fill_plain, take_plain}, {fill_avx2, take_avx2}, {fill_avx512, take_avx512}};
#else
constexpr JitteredKernel kKernels[] = {{fill_plain, take_plain}};
#endif

}  // namespace

std::span<const JitteredKernel> jittered_kernels() { return {kKernels, usable_sets()}; }

void JitteredGrid::fill(const Key& key, double* x, double* y) const noexcept {
  jittered_kernels().back().fill(*this, key, x, y);
}

CellPoints JitteredGrid::take_cells(const Key& key, std::span<const CellSpan> counted, std::span<const CellSpan> filled,
                                    Points out) const noexcept {
  CellPoints points;
  for (const CellSpan& span : counted) points.counted += span.end - span.begin;
  points.filled = jittered_kernels().back().take(*this, key, filled, out.x.data(), out.y.data());
  return points;
}

}  // namespace moire
