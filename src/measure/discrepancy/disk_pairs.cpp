// Images of a point on the torus and their overlaps, plainly and with the vectors of AVX2.
#include "measure/discrepancy/disk_pairs.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#if defined(__x86_64__)
#include <immintrin.h>
#endif

namespace moire {
namespace {

// 2R <= 1/2: at most one image of the other point is that near, the nearest along both axes.
void one_image_plain(const DiskOverlap& overlap, double scale, double row_x, double row_y, const double* x,
                     const double* y, double* value) {
  for (std::size_t i = 0; i < kPairLanes; ++i) {
    const double a = std::fabs(row_x - x[i]), b = std::fabs(row_y - y[i]);
    const double u = std::min(a, 1 - a), v = std::min(b, 1 - b);
    value[i] = overlap((u * u + v * v) * scale);
  }
}

// 2R <= 1: four images, the nearest and the next one along each axis; all others are 1 away or more. None of the four
// may be left out: of all places in the square the second and the third reach 91%, the fourth 31%.
void four_images_plain(const DiskOverlap& overlap, double scale, double row_x, double row_y, const double* x,
                       const double* y, double* value) {
  for (std::size_t i = 0; i < kPairLanes; ++i) {
    const double a = std::fabs(row_x - x[i]), b = std::fabs(row_y - y[i]);
    const double u = std::min(a, 1 - a), far_u = std::max(a, 1 - a), v = std::min(b, 1 - b), far_v = std::max(b, 1 - b);
    const double x2 = u * u * scale, y2 = v * v * scale, far_x2 = far_u * far_u * scale, far_y2 = far_v * far_v * scale;
    value[i] = (overlap(x2 + y2) + overlap(far_x2 + far_y2)) + (overlap(far_x2 + y2) + overlap(x2 + far_y2));
  }
}

#if defined(__x86_64__)
// Four overlaps, by the operations of DiskOverlap::operator(). A piece is loaded as a row of 8 powers; rows are turned
// into columns by pairs, which costs less than a gather of each power.
[[gnu::target("avx2"), gnu::always_inline]] inline __m256d four_overlaps(const DiskOverlap::Piece* pieces, __m256d q) {
  const __m256d p = _mm256_sub_pd(_mm256_set1_pd(1), q);
  const __m256d m = _mm256_max_pd(_mm256_min_pd(p, q), _mm256_set1_pd(DiskOverlap::kEnd));
  const __m256i bits = _mm256_castpd_si256(m);
  const __m256i number =
      _mm256_sub_epi64(_mm256_srli_epi64(bits, DiskOverlap::kShift), _mm256_set1_epi64x(DiskOverlap::kFirst));
  // -1 where p is the smaller
  const __m256i p_is_smaller = _mm256_castpd_si256(_mm256_cmp_pd(p, q, _CMP_LT_OQ));
  const __m256i piece = _mm256_sub_epi64(_mm256_add_epi64(number, number), p_is_smaller);
  const __m128i low = _mm256_castsi256_si128(piece), high = _mm256_extracti128_si256(piece, 1);
  const double* const row0 = pieces[_mm_cvtsi128_si64(low)].a;
  const double* const row1 = pieces[_mm_extract_epi64(low, 1)].a;
  const double* const row2 = pieces[_mm_cvtsi128_si64(high)].a;
  const double* const row3 = pieces[_mm_extract_epi64(high, 1)].a;
  const __m256d centre =
      _mm256_castsi256_pd(_mm256_or_si256(_mm256_and_si256(bits, _mm256_set1_epi64x(DiskOverlap::kPieceBits)),
                                          _mm256_set1_epi64x(DiskOverlap::kHalfPiece)));
  const __m256d t = _mm256_sub_pd(m, centre), t2 = _mm256_mul_pd(t, t);
  __m256d sum = _mm256_setzero_pd();
#pragma GCC unroll 4
  for (int k = 6; k >= 0; k -= 2) {
    const __m256d even = _mm256_insertf128_pd(_mm256_castpd128_pd256(_mm_load_pd(row0 + k)), _mm_load_pd(row2 + k), 1);
    const __m256d odd = _mm256_insertf128_pd(_mm256_castpd128_pd256(_mm_load_pd(row1 + k)), _mm_load_pd(row3 + k), 1);
    const __m256d pair = _mm256_add_pd(_mm256_unpacklo_pd(even, odd), _mm256_mul_pd(_mm256_unpackhi_pd(even, odd), t));
    sum = k == 6 ? pair : _mm256_add_pd(_mm256_mul_pd(sum, t2), pair);
  }
  return sum;
}

[[gnu::target("avx2"), gnu::always_inline]] inline __m256d distance(double row, const double* columns) {
  return _mm256_andnot_pd(_mm256_set1_pd(-0.0), _mm256_sub_pd(_mm256_set1_pd(row), _mm256_loadu_pd(columns)));
}

// A lambda would not take the instruction set of the function around it.
[[gnu::target("avx2"), gnu::always_inline]] inline __m256d scaled_square(__m256d v, __m256d scale) {
  return _mm256_mul_pd(_mm256_mul_pd(v, v), scale);
}

[[gnu::target("avx2")]] void one_image_avx2(const DiskOverlap& overlap, double scale, double row_x, double row_y,
                                            const double* x, const double* y, double* value) {
  const __m256d one = _mm256_set1_pd(1), s = _mm256_set1_pd(scale);
  for (std::size_t i = 0; i < kPairLanes; i += 4) {
    const __m256d a = distance(row_x, x + i), b = distance(row_y, y + i);
    const __m256d u = _mm256_min_pd(a, _mm256_sub_pd(one, a)), v = _mm256_min_pd(b, _mm256_sub_pd(one, b));
    const __m256d q = _mm256_mul_pd(_mm256_add_pd(_mm256_mul_pd(u, u), _mm256_mul_pd(v, v)), s);
    _mm256_storeu_pd(value + i, four_overlaps(overlap.pieces(), q));
  }
}

[[gnu::target("avx2")]] void four_images_avx2(const DiskOverlap& overlap, double scale, double row_x, double row_y,
                                              const double* x, const double* y, double* value) {
  const DiskOverlap::Piece* const pieces = overlap.pieces();
  const __m256d one = _mm256_set1_pd(1), s = _mm256_set1_pd(scale);
  for (std::size_t i = 0; i < kPairLanes; i += 4) {
    const __m256d a = distance(row_x, x + i), other_a = _mm256_sub_pd(one, a);
    const __m256d b = distance(row_y, y + i), other_b = _mm256_sub_pd(one, b);
    const __m256d x2 = scaled_square(_mm256_min_pd(a, other_a), s);
    const __m256d far_x2 = scaled_square(_mm256_max_pd(a, other_a), s);
    const __m256d y2 = scaled_square(_mm256_min_pd(b, other_b), s);
    const __m256d far_y2 = scaled_square(_mm256_max_pd(b, other_b), s);
    const __m256d ends = _mm256_add_pd(four_overlaps(pieces, _mm256_add_pd(x2, y2)),
                                       four_overlaps(pieces, _mm256_add_pd(far_x2, far_y2)));
    const __m256d sides = _mm256_add_pd(four_overlaps(pieces, _mm256_add_pd(far_x2, y2)),
                                        four_overlaps(pieces, _mm256_add_pd(x2, far_y2)));
    _mm256_storeu_pd(value + i, _mm256_add_pd(ends, sides));
  }
}

constexpr DiskTerms kOneImage[] = {one_image_plain, one_image_avx2};
constexpr DiskTerms kFourImages[] = {four_images_plain, four_images_avx2};
std::size_t usable() { return __builtin_cpu_supports("avx2") ? 2 : 1; }
#else
constexpr DiskTerms kOneImage[] = {one_image_plain};
constexpr DiskTerms kFourImages[] = {four_images_plain};
std::size_t usable() { return 1; }
#endif

}  // namespace

std::span<const DiskTerms> disk_terms() { return std::span<const DiskTerms>(kFourImages, usable()); }
std::span<const DiskTerms> disk_terms_of_one_image() { return std::span<const DiskTerms>(kOneImage, usable()); }

}  // namespace moire
