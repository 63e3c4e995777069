// Sums over all ordered pairs of points of a symmetric function of their difference, with rounding errors that do not
// grow with the number of points and bits that depend neither on threads nor on the width of the machine's vectors.
#pragma once

#include <algorithm>
#include <cstddef>
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

// Rows of lanes are added into high + low: the error of each lane stays below 2^-98 of it.
[[gnu::always_inline]] inline void add_row(const double* sum, double* high, double* low) {
  for (std::size_t lane = 0; lane < kPairLanes; ++lane) {
    const Dd s = two_sum(high[lane], sum[lane]);
    high[lane] = s.hi;
    low[lane] += s.lo;
  }
}
[[gnu::always_inline]] inline Dd sum_of_rows(const double* high, const double* low) {
  Dd total;
  for (std::size_t lane = 0; lane < kPairLanes; ++lane) total = total + quick_two_sum(high[lane], low[lane]);
  return total;
}

// The sum of term(x_i - x_j, y_i - y_j) over all i of `rows` and j of `columns`. Column j belongs to lane j mod
// kPairLanes; per row every lane is summed plainly, rows and lanes are added with a relative error of 2^-98.
// Inlined always, so that it takes the instruction set of its caller.
template <class Term>
[[gnu::always_inline]] inline Dd sum_of_tile(const Term& term, PairBlock rows, PairBlock columns) {
  const double *const x = columns.x.data(), *const y = columns.y.data();
  const std::size_t full = columns.x.size() / kPairLanes * kPairLanes, rest = columns.x.size() - full;
  double high[kPairLanes] = {}, low[kPairLanes] = {};
  for (std::size_t i = 0; i < rows.x.size(); ++i) {
    const double row_x = rows.x[i], row_y = rows.y[i];
    double sum[kPairLanes] = {};
    for (std::size_t j = 0; j < full; j += kPairLanes) {
      double value[kPairLanes];  // two loops, or clang vectorises neither
      for (std::size_t lane = 0; lane < kPairLanes; ++lane)
        value[lane] = term(row_x - x[j + lane], row_y - y[j + lane]);
      for (std::size_t lane = 0; lane < kPairLanes; ++lane) sum[lane] += value[lane];
    }
    for (std::size_t lane = 0; lane < rest; ++lane) sum[lane] += term(row_x - x[full + lane], row_y - y[full + lane]);
    add_row(sum, high, low);
  }
  return sum_of_rows(high, low);
}

// The same where terms(row_x, row_y, x, y, value) writes the kPairLanes values of a row and as many columns.
template <class Terms>
[[gnu::always_inline]] inline Dd sum_of_lanes(const Terms& terms, PairBlock rows, PairBlock columns) {
  const double *const x = columns.x.data(), *const y = columns.y.data();
  const std::size_t full = columns.x.size() / kPairLanes * kPairLanes, rest = columns.x.size() - full;
  // Lanes without a column repeat the last one, and are not added.
  double last_x[kPairLanes] = {}, last_y[kPairLanes] = {};
  for (std::size_t lane = 0; rest > 0 && lane < kPairLanes; ++lane) {
    last_x[lane] = x[full + std::min(lane, rest - 1)];
    last_y[lane] = y[full + std::min(lane, rest - 1)];
  }
  double high[kPairLanes] = {}, low[kPairLanes] = {};
  for (std::size_t i = 0; i < rows.x.size(); ++i) {
    double sum[kPairLanes] = {}, value[kPairLanes];
    for (std::size_t j = 0; j < full; j += kPairLanes) {
      terms(rows.x[i], rows.y[i], x + j, y + j, value);
      for (std::size_t lane = 0; lane < kPairLanes; ++lane) sum[lane] += value[lane];
    }
    if (rest > 0) terms(rows.x[i], rows.y[i], last_x, last_y, value);
    for (std::size_t lane = 0; lane < rest; ++lane) sum[lane] += value[lane];
    add_row(sum, high, low);
  }
  return sum_of_rows(high, low);
}

// The sum over all N^2 ordered pairs, each point with itself among them. tile(rows, columns) is sum_of_tile for a term
// that has the same value at (dx, dy) and (-dx, -dy); it may be called from several threads.
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
