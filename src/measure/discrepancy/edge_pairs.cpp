// Distances of pairs, and the probability that the printed generator's line separates them.
#include "measure/discrepancy/edge_pairs.h"

#include <cmath>
#include <cstdint>
#include <cstring>

#include "core/instruction_sets.h"
#include "core/lanes.h"
#include "measure/discrepancy/wide_distances.h"

namespace moire {
namespace {

constexpr std::int64_t kMagnitude = 0x7fffffffffffffff;  // all bits but the sign

// Both terms add the values of a register of columns and each of kRows rows to sum[row][part].

struct Distance {
  template <class V, class Mask, std::size_t kRows, std::size_t kParts>
  [[gnu::always_inline]] static void add(const double* row_x, const double* row_y, const V& x, const V& y,
                                         std::size_t part, V (&sum)[kRows][kParts]) {
    constexpr std::size_t kWidth = sizeof(V) / sizeof(double);
    for (std::size_t r = 0; r < kRows; ++r) {
      const V dx = row_x[r] - x, dy = row_y[r] - y;
      V distance = dx * dx + dy * dy;
      double root[kWidth];
      std::memcpy(root, &distance, sizeof root);
      for (double& each : root) each = std::sqrt(each);
      std::memcpy(&distance, root, sizeof root);
      sum[r][part] += distance;
    }
  }
};

// atanh(s) / s in powers of s^2, s <= 1/3: Chebyshev's expansion over [0, 1/9], cut after 11 terms and with its
// coefficients rounded, is within 2.5e-18.
constexpr double kAtanh[] = {0x1p+0,
                             0x1.5555555555526p-2,
                             0x1.99999999a1ed1p-3,
                             0x1.2492492009c9cp-3,
                             0x1.c71c744e01706p-4,
                             0x1.745cae5cdec88p-4,
                             0x1.3b1e423307d9fp-4,
                             0x1.10632786a2475p-4,
                             0x1.f01958209fc71p-5,
                             0x1.54b093b32599bp-5,
                             0x1.5d5192c5c16ebp-4};

// The lines y = m x + b that D. P. Mitchell's generator draws have directions with density 1 / max(|cos|, |sin|)^2 and,
// given their direction, uniform places. With u >= v >= 0 the larger and the smaller of |dx| and |dy| they separate two
// points with the probability h = ((u - v) + (u + v) ln(1 + v/u)) / 2.
//
// The polynomial is one long chain of operations that wait for each other, so the chains of several rows go side by
// side: of eight, twice as quick as of one.
struct Separation {
  template <class V, class Mask, std::size_t kRows, std::size_t kParts>
  [[gnu::always_inline]] static void add(const double* row_x, const double* row_y, const V& x, const V& y,
                                         std::size_t part, V (&sum)[kRows][kParts]) {
    V u[kRows], v[kRows], s[kRows], z[kRows], series[kRows];
    for (std::size_t r = 0; r < kRows; ++r) {
      const V a = (V)((Mask)(row_x[r] - x) & kMagnitude), b = (V)((Mask)(row_y[r] - y) & kMagnitude);
      u[r] = a > b ? a : b;
      v[r] = a > b ? b : a;
      // ln(1 + v/u) = 2 atanh(s); points that coincide have v = 0, and the least number keeps 0/0 away.
      s[r] = v[r] / (u[r] + v[r] + u[r] + 0x1p-1022);
      z[r] = s[r] * s[r];
      series[r] = kAtanh[10] * z[r] + kAtanh[9];
    }
    for (std::size_t k = 9; k-- > 0;)
      for (std::size_t r = 0; r < kRows; ++r) series[r] = series[r] * z[r] + kAtanh[k];
    for (std::size_t r = 0; r < kRows; ++r) sum[r][part] += 0.5 * (u[r] - v[r]) + (u[r] + v[r]) * (s[r] * series[r]);
  }
};

// Registers of columns, beginning with (x, y), kPairLanes in all.
template <class Term, class V, class Mask, std::size_t kRows, std::size_t kParts>
[[gnu::always_inline]] inline void add_columns(const double* row_x, const double* row_y, const double* column_x,
                                               const double* column_y, V (&sum)[kRows][kParts]) {
  for (std::size_t part = 0; part < kParts; ++part) {
    V x, y;
    load(column_x + part * (kPairLanes / kParts), x);
    load(column_y + part * (kPairLanes / kParts), y);
    Term::template add<V, Mask>(row_x, row_y, x, y, part, sum);
  }
}

// Of kRows rows and all columns into (high, low).
template <class Term, class V, class Mask, std::size_t kRows>
[[gnu::always_inline]] inline void add_rows(const double* row_x, const double* row_y, const PaddedColumns& columns,
                                            PairRow& high, PairRow& low) {
  constexpr std::size_t kParts = kPairLanes * sizeof(double) / sizeof(V);
  V sum[kRows][kParts] = {};
  for (std::size_t j = 0; j < columns.full; j += kPairLanes)
    add_columns<Term, V, Mask>(row_x, row_y, columns.x + j, columns.y + j, sum);
  PairRow row[kRows];
  std::memcpy(row, sum, sizeof row);
  if (columns.rest > 0) {
    V last[kRows][kParts] = {};
    add_columns<Term, V, Mask>(row_x, row_y, columns.last_x, columns.last_y, last);
    PairRow last_row[kRows];
    std::memcpy(last_row, last, sizeof last_row);
    for (std::size_t r = 0; r < kRows; ++r) row[r] += columns.weight * last_row[r];
  }
  for (std::size_t r = 0; r < kRows; ++r) add_row(row[r], high, low);
}

// Column j belongs to lane j mod kPairLanes; per row every lane is summed plainly, rows and lanes are added with a
// relative error of 2^-98.
template <class Term, class V, class Mask>
[[gnu::always_inline]] inline Dd sum_of_tile(PairBlock rows, PairBlock columns) {
  constexpr std::size_t kRows = 8;
  const PaddedColumns padded(columns);
  const double *const x = rows.x.data(), *const y = rows.y.data();
  PairRow high{}, low{};
  std::size_t i = 0;
  for (; i + kRows <= rows.x.size(); i += kRows) add_rows<Term, V, Mask, kRows>(x + i, y + i, padded, high, low);
  for (; i < rows.x.size(); ++i) add_rows<Term, V, Mask, 1>(x + i, y + i, padded, high, low);
  return sum_of_lanes(high, low);
}

Dd distances_plain(PairBlock rows, PairBlock columns) {
  return sum_of_tile<Distance, NarrowLanes, NarrowLaneMask>(rows, columns);
}
Dd separations_plain(PairBlock rows, PairBlock columns) {
  return sum_of_tile<Separation, NarrowLanes, NarrowLaneMask>(rows, columns);
}
#if MOIRE_HAS_AVX
[[MOIRE_AVX2]] Dd distances_avx2(PairBlock rows, PairBlock columns) {
  return sum_of_tile<Distance, Lanes, LaneMask>(rows, columns);
}
[[MOIRE_AVX2]] Dd separations_avx2(PairBlock rows, PairBlock columns) {
  return sum_of_tile<Separation, Lanes, LaneMask>(rows, columns);
}
[[MOIRE_AVX512]] Dd separations_avx512(PairBlock rows, PairBlock columns) {
  return sum_of_tile<Separation, WideLanes, WideLaneMask>(rows, columns);
}
constexpr PairTile kDistances[] = {distances_plain, distances_avx2, distances_avx512};
constexpr PairTile kSeparations[] = {separations_plain, separations_avx2, separations_avx512};
#else
constexpr PairTile kDistances[] = {distances_plain};
constexpr PairTile kSeparations[] = {separations_plain};
#endif

}  // namespace

std::span<const PairTile> edge_pair_tiles(LineLaw law) {
  return law == LineLaw::isotropic ? std::span<const PairTile>(kDistances, usable_sets())
                                   : std::span<const PairTile>(kSeparations, usable_sets());
}

}  // namespace moire
