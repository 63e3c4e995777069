// Sums over all ordered pairs of points of a symmetric function of their difference, with rounding errors that do not
// grow with the number of points and bits that depend neither on threads nor on the width of the machine's vectors.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <span>
#include <vector>

#include "core/double_double.h"
#include "core/parallel.h"
#include "measure/discrepancy/point_view.h"

namespace moire {

// Points of a row and of a column of tiles; x and y of one length.
struct PairBlock {
  std::span<const double> x, y;
};

// Points per block, and partial sums that stand side by side. A plain sum has at most kPairBlock / kPairLanes = 16
// terms: for terms >= 0 its relative error is below 15 u.
inline constexpr std::size_t kPairBlock = 128, kPairLanes = 8;

// One number per lane, in as many registers as it takes: compilers would add single numbers.
using PairRow [[gnu::vector_size(kPairLanes * sizeof(double))]] = double;

// Rows of lanes are added into high + low, by two_sum: the error of each lane stays below 2^-98 of it. By reference:
// passed by value, vectors would have another calling convention on every instruction set.
[[gnu::always_inline]] inline void add_row(const PairRow& row, PairRow& high, PairRow& low) {
  const PairRow sum = high + row, of_row = sum - high;
  low += (high - (sum - of_row)) + (row - of_row);
  high = sum;
}
[[gnu::always_inline]] inline Dd sum_of_lanes(const PairRow& high, const PairRow& low) {
  Dd total;
  for (std::size_t lane = 0; lane < kPairLanes; ++lane) total = total + quick_two_sum(high[lane], low[lane]);
  return total;
}

// The columns of a tile: those that fill rows of lanes, and a last row of what is left. Its lanes without a column
// repeat the last one, and their weight is 0 where it is 1 elsewhere. Were the columns that are left added one by one,
// compilers would keep the lanes of a sum as single numbers all along.
struct PaddedColumns {
  const double *x, *y;
  std::size_t full, rest;
  double last_x[kPairLanes] = {}, last_y[kPairLanes] = {};
  PairRow weight{};

  [[gnu::always_inline]] explicit PaddedColumns(PairBlock columns)
      : x(columns.x.data()),
        y(columns.y.data()),
        full(columns.x.size() / kPairLanes * kPairLanes),
        rest(columns.x.size() - full) {
    for (std::size_t lane = 0; rest > 0 && lane < kPairLanes; ++lane) {
      last_x[lane] = x[full + std::min(lane, rest - 1)];
      last_y[lane] = y[full + std::min(lane, rest - 1)];
      weight[lane] = lane < rest ? 1 : 0;
    }
  }
};

// The sum over all i of `rows` and j of `columns` of values that are none below 0. Column j belongs to lane j mod
// kPairLanes; per row every lane is summed plainly, rows and lanes are added with a relative error of 2^-98.
// terms(row_x, row_y, x, y, sum) adds the values of one row and columns (x, y), a multiple of kPairLanes, to the sums.
// Inlined always, so that it takes the instruction set of its caller.
template <class Terms>
[[gnu::always_inline]] inline Dd sum_of_rows(const Terms& terms, PairBlock rows, PairBlock columns) {
  const PaddedColumns padded(columns);
  const std::size_t full = padded.full;
  PairRow high{}, low{};
  for (std::size_t i = 0; i < rows.x.size(); ++i) {
    PairRow sum{}, last{};
    terms(rows.x[i], rows.y[i], columns.x.first(full), columns.y.first(full), sum);
    if (padded.rest > 0) {
      terms(rows.x[i], rows.y[i], padded.last_x, padded.last_y, last);
      sum += padded.weight * last;
    }
    add_row(sum, high, low);
  }
  return sum_of_lanes(high, low);
}

// The sum over all N^2 ordered pairs, each point with itself among them. tile(rows, columns) sums a function of two
// points that has the same value when they change places; it may be called from several threads.
template <class Tile>
Dd sum_over_pairs(const PointView& points, const Tile& tile) {
  const std::size_t n = points.size(), blocks = (n + kPairBlock - 1) / kPairBlock;
  const auto block = [&](std::size_t b) {
    const std::size_t begin = b * kPairBlock, count = std::min(kPairBlock, n - begin);
    return PairBlock{points.x.subspan(begin, count), points.y.subspan(begin, count)};
  };
  std::vector<Dd> sums(blocks);
  const auto sum_row = [&](std::size_t b) {
    Dd right;
    for (std::size_t c = b + 1; c < blocks; ++c) right = right + tile(block(b), block(c));
    sums[b] = right + right + tile(block(b), block(b));
  };
  // Waking threads costs more than a few blocks do.
  if (blocks < 8) {
    for (std::size_t b = 0; b < blocks; ++b) sum_row(b);
  } else {
    parallel_for(blocks, sum_row);
  }
  Dd total;
  for (const Dd& sum : sums) total = total + sum;
  return total;
}

}  // namespace moire
