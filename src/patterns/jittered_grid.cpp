// Points of a jittered grid: the hash of each cell, then its place. A few hundred at a time, so that they stay in the
// first cache between the two loops.
//
// ns per point, g++ 12 -O3, plain, AVX2 and AVX-512: 6.7, 3.5 and 1.6 for 16 x 16 cells, 7.5, 5.5 and 4.2 for 15 x 15,
// which must divide; some 20 cells taken singly 14, 8.5 and 5.
#include "patterns/jittered_grid.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>

#include "core/instruction_sets.h"

namespace moire {
namespace {

constexpr int kChunk = 512;
constexpr int kWidest = 16;  // points in the widest vector: lists of cells are padded to whole ones

// Offsets of points in their cells, before they are placed; index(i) is the number of point i.
template <class Index>
[[gnu::always_inline]] inline void make_offsets(const JitteredGrid& grid, const Key& key, const Index& index, int count,
                                                double* __restrict x, double* __restrict y) noexcept {
  const Strata across = grid.across, down = grid.down;
  for (int i = 0; i < count; ++i) {
    const Words w = hash(key, index(i), Axis::xy);
    x[i] = across.offset_of_digits(digits52(w.a, w.b));
    y[i] = down.offset_of_digits(digits52(w.c, w.d));
  }
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

// Whole rows at a time; of long rows, parts.
[[gnu::always_inline]] inline void fill_grid(const JitteredGrid& grid, const Key& key, double* x, double* y) noexcept {
  const int columns = grid.columns, n = columns * grid.rows;
  const int together = columns < kChunk ? kChunk / columns * columns : kChunk;
  int row = 0, column = 0;
  for (int done = 0; done < n;) {
    const int count = columns < kChunk ? std::min(together, n - done) : std::min(kChunk, columns - column);
    make_offsets(
        grid, key, [done](int i) { return static_cast<std::uint32_t>(done + i); }, count, x, y);
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
    make_offsets(
        grid, key, [=](int i) { return static_cast<std::uint32_t>(r[i] * columns + c[i]); }, padded, px.data(),
        py.data());
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

void fill_plain(const JitteredGrid& grid, const Key& key, double* x, double* y) noexcept { fill_grid(grid, key, x, y); }
std::size_t take_plain(const JitteredGrid& grid, const Key& key, std::span<const CellSpan> cells, double* x,
                       double* y) noexcept {
  return take_grid(grid, key, cells, x, y);
}

#if MOIRE_HAS_AVX
[[MOIRE_AVX2]] void fill_avx2(const JitteredGrid& grid, const Key& key, double* x, double* y) noexcept {
  fill_grid(grid, key, x, y);
}
[[MOIRE_AVX2]] std::size_t take_avx2(const JitteredGrid& grid, const Key& key, std::span<const CellSpan> cells,
                                     double* x, double* y) noexcept {
  return take_grid(grid, key, cells, x, y);
}
[[MOIRE_AVX512]] void fill_avx512(const JitteredGrid& grid, const Key& key, double* x, double* y) noexcept {
  fill_grid(grid, key, x, y);
}
[[MOIRE_AVX512]] std::size_t take_avx512(const JitteredGrid& grid, const Key& key, std::span<const CellSpan> cells,
                                         double* x, double* y) noexcept {
  return take_grid(grid, key, cells, x, y);
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
