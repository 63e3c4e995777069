// Sums of distances with AVX-512: the tile of edge_pairs.cpp around square roots by Newton's iteration.
#include "measure/discrepancy/wide_distances.h"

#include <cstring>

#include "measure/discrepancy/wide_roots.h"

#if MOIRE_HAS_AVX
namespace moire {
namespace {

// Rows side by side, which share what is loaded of the columns, and roots side by side: more of them, and the
// instructions that wait for each other fill the machine's window.
constexpr std::size_t kRows = 8, kRoots = 2;

// Of kCount rows and of columns that fill a register.
template <std::size_t kCount>
[[MOIRE_AVX512]] [[gnu::always_inline]] inline void add_columns(const double* row_x, const double* row_y,
                                                                const double* column_x, const double* column_y,
                                                                __m512d (&sum)[kCount]) {
  constexpr std::size_t kTogether = kCount < kRoots ? kCount : kRoots;
  const __m512d x = _mm512_loadu_pd(column_x), y = _mm512_loadu_pd(column_y);
#pragma GCC unroll 8
  for (std::size_t first = 0; first < kCount; first += kTogether) {
    __m512d square[kTogether], distance[kTogether];
#pragma GCC unroll 8
    for (std::size_t i = 0; i < kTogether; ++i) {
      const __m512d dx = _mm512_sub_pd(_mm512_set1_pd(row_x[first + i]), x);
      const __m512d dy = _mm512_sub_pd(_mm512_set1_pd(row_y[first + i]), y);
      square[i] = _mm512_add_pd(_mm512_mul_pd(dx, dx), _mm512_mul_pd(dy, dy));
    }
    square_roots(square, distance);
#pragma GCC unroll 8
    for (std::size_t i = 0; i < kTogether; ++i) sum[first + i] = _mm512_add_pd(sum[first + i], distance[i]);
  }
}

// Of kCount rows and all columns into (high, low).
template <std::size_t kCount>
[[MOIRE_AVX512]] [[gnu::always_inline]] inline void add_rows(const double* row_x, const double* row_y,
                                                             const PaddedColumns& columns, PairRow& high,
                                                             PairRow& low) {
  static_assert(sizeof(__m512d) == sizeof(PairRow));
  __m512d sum[kCount] = {};
  for (std::size_t j = 0; j < columns.full; j += kPairLanes)
    add_columns(row_x, row_y, columns.x + j, columns.y + j, sum);
  PairRow row[kCount];
  std::memcpy(row, sum, sizeof row);
  if (columns.rest > 0) {
    __m512d last[kCount] = {};
    add_columns(row_x, row_y, columns.last_x, columns.last_y, last);
    PairRow last_row[kCount];
    std::memcpy(last_row, last, sizeof last_row);
    for (std::size_t r = 0; r < kCount; ++r) row[r] += columns.weight * last_row[r];
  }
  for (std::size_t r = 0; r < kCount; ++r) add_row(row[r], high, low);
}

}  // namespace

[[MOIRE_AVX512]] Dd distances_avx512(PairBlock rows, PairBlock columns) {
  const PaddedColumns padded(columns);
  const double *const x = rows.x.data(), *const y = rows.y.data();
  PairRow high{}, low{};
  std::size_t i = 0;
  for (; i + kRows <= rows.x.size(); i += kRows) add_rows<kRows>(x + i, y + i, padded, high, low);
  for (; i < rows.x.size(); ++i) add_rows<1>(x + i, y + i, padded, high, low);
  return sum_of_lanes(high, low);
}

}  // namespace moire
#endif
