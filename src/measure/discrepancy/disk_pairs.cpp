// Images of a point on the torus and their overlaps, a row of pairs at a time, plainly and with wide vectors.
#include "measure/discrepancy/disk_pairs.h"

#include <cmath>
#include <cstdint>
#include <cstring>

#include "core/instruction_sets.h"
#include "core/lanes.h"

#if MOIRE_HAS_AVX
#include <immintrin.h>
#endif

namespace moire {
namespace {

// One image of each of the columns. Where in the table to look is found for all of them first: vectors do that, and the
// numbers of pieces go through memory, which is quicker than out of vectors.
struct Image {
  double value[kPairBlock + kPairLanes];  // q, then the place in the piece, then the overlap
  std::int64_t piece[kPairBlock + kPairLanes];
};

// The arithmetic of DiskOverlap::operator(), up to the polynomial; n is a multiple of kPairLanes.
template <class V, class Mask>
[[gnu::always_inline]] inline void look_up(std::size_t n, Image& image) {
  using Bits [[gnu::vector_size(sizeof(V))]] = std::uint64_t;
  for (std::size_t i = 0; i < n; i += sizeof(V) / sizeof(double)) {
    V q;
    load(image.value + i, q);
    const V p = 1 - q, smaller = p < q ? p : q, end = V{} + DiskOverlap::kEnd, m = smaller > end ? smaller : end;
    const Bits bits = (Bits)m, number = (bits >> DiskOverlap::kShift) - static_cast<std::uint64_t>(DiskOverlap::kFirst);
    const Mask piece = (Mask)(number + number) - (Mask)(p < q);  // true is -1
    const V t = m - (V)((bits & static_cast<std::uint64_t>(DiskOverlap::kPieceBits)) |
                        static_cast<std::uint64_t>(DiskOverlap::kHalfPiece));
    std::memcpy(image.piece + i, &piece, sizeof piece);
    std::memcpy(image.value + i, &t, sizeof t);
  }
}

// 2R <= 1/2: at most one image of the other point is that near, the nearest along both axes.
[[gnu::always_inline]] inline void place_one(double scale, double row_x, double row_y, std::span<const double> x,
                                             std::span<const double> y, Image& image) {
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double a = std::fabs(row_x - x[i]), b = std::fabs(row_y - y[i]), other_a = 1 - a, other_b = 1 - b;
    const double u = a < other_a ? a : other_a, v = b < other_b ? b : other_b;
    image.value[i] = (u * u + v * v) * scale;
  }
}

// 2R <= 1: four images, the nearest and the next one along each axis; all others are 1 away or more. None of the four
// may be left out: of all places in the square the last two reach 91%, the second 31%.
[[gnu::always_inline]] inline void place_four(double scale, double row_x, double row_y, std::span<const double> x,
                                              std::span<const double> y, Image (&image)[4]) {
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double a = std::fabs(row_x - x[i]), b = std::fabs(row_y - y[i]), other_a = 1 - a, other_b = 1 - b;
    const double u = a < other_a ? a : other_a, far_u = a < other_a ? other_a : a;
    const double v = b < other_b ? b : other_b, far_v = b < other_b ? other_b : b;
    const double x2 = u * u * scale, y2 = v * v * scale, far_x2 = far_u * far_u * scale, far_y2 = far_v * far_v * scale;
    image[0].value[i] = x2 + y2;
    image[1].value[i] = far_x2 + far_y2;
    image[2].value[i] = far_x2 + y2;
    image[3].value[i] = x2 + far_y2;
  }
}

[[gnu::always_inline]] inline void load_row(const Image& image, std::size_t i, PairRow& row) {
  std::memcpy(&row, image.value + i, sizeof row);
}

[[gnu::always_inline]] inline void add_one(const Image& image, std::size_t n, PairRow& sum) {
  for (std::size_t i = 0; i < n; i += kPairLanes) {
    PairRow value;
    load_row(image, i, value);
    sum += value;
  }
}

[[gnu::always_inline]] inline void add_four(const Image (&image)[4], const double* of_farthest, std::size_t n,
                                            PairRow& sum) {
  for (std::size_t i = 0; i < n; i += kPairLanes) {
    PairRow nearest, farthest, beside, above;
    load_row(image[0], i, nearest);
    std::memcpy(&farthest, of_farthest + i, sizeof farthest);
    load_row(image[2], i, beside);
    load_row(image[3], i, above);
    sum += (nearest + farthest) + (beside + above);
  }
}

void evaluate_plain(const DiskOverlap::Piece* pieces, std::size_t n, Image& image) {
  for (std::size_t i = 0; i < n; ++i) {
    const double* const a = pieces[image.piece[i]].a;
    const double t = image.value[i], t2 = t * t;
    image.value[i] = (((a[6] + a[7] * t) * t2 + (a[4] + a[5] * t)) * t2 + (a[2] + a[3] * t)) * t2 + (a[0] + a[1] * t);
  }
}

void one_image_plain(const DiskOverlap& overlap, double scale, double row_x, double row_y, std::span<const double> x,
                     std::span<const double> y, PairRow& sum) {
  Image image;
  place_one(scale, row_x, row_y, x, y, image);
  look_up<NarrowLanes, NarrowLaneMask>(x.size(), image);
  evaluate_plain(overlap.pieces(), x.size(), image);
  add_one(image, x.size(), sum);
}

void four_images_plain(const DiskOverlap& overlap, double scale, double row_x, double row_y, std::span<const double> x,
                       std::span<const double> y, PairRow& sum) {
  Image image[4];
  place_four(scale, row_x, row_y, x, y, image);
  for (Image& each : image) {
    look_up<NarrowLanes, NarrowLaneMask>(x.size(), each);
    evaluate_plain(overlap.pieces(), x.size(), each);
  }
  add_four(image, image[1].value, x.size(), sum);
}

#if MOIRE_HAS_AVX
// Four polynomials at a time. A piece is loaded as a row of 8 powers; rows are turned into columns by pairs, which
// costs less than a gather of each power.
[[MOIRE_AVX2]] void evaluate_avx2(const DiskOverlap::Piece* pieces, std::size_t n, Image& image) {
  for (std::size_t i = 0; i < n; i += 4) {
    const double *const row0 = pieces[image.piece[i]].a, *const row1 = pieces[image.piece[i + 1]].a,
                        *const row2 = pieces[image.piece[i + 2]].a, *const row3 = pieces[image.piece[i + 3]].a;
    const __m256d t = _mm256_loadu_pd(image.value + i), t2 = _mm256_mul_pd(t, t);
    __m256d sum = _mm256_setzero_pd();
#pragma GCC unroll 4
    for (int k = 6; k >= 0; k -= 2) {
      const __m256d even =
          _mm256_insertf128_pd(_mm256_castpd128_pd256(_mm_load_pd(row0 + k)), _mm_load_pd(row2 + k), 1);
      const __m256d odd = _mm256_insertf128_pd(_mm256_castpd128_pd256(_mm_load_pd(row1 + k)), _mm_load_pd(row3 + k), 1);
      const __m256d pair =
          _mm256_add_pd(_mm256_unpacklo_pd(even, odd), _mm256_mul_pd(_mm256_unpackhi_pd(even, odd), t));
      sum = k == 6 ? pair : _mm256_add_pd(_mm256_mul_pd(sum, t2), pair);
    }
    _mm256_storeu_pd(image.value + i, sum);
  }
}

// Eight at a time: halves of two rows are joined as they are loaded, and 4 x 4 numbers turned within each half. (Plain
// shuffles of GCC 12's header would warn of numbers that are not set; those that take a mask do not.)
[[MOIRE_AVX512]] void evaluate_avx512(const DiskOverlap::Piece* pieces, std::size_t n, Image& image) {
  constexpr __mmask8 kAll = 0xff, kUpper = 0xf0;
  for (std::size_t i = 0; i < n; i += 8) {
    const std::int64_t* const piece = image.piece + i;
    const __m512d t = _mm512_loadu_pd(image.value + i), t2 = _mm512_mul_pd(t, t);
    __m512d sum = _mm512_setzero_pd();
#pragma GCC unroll 2
    for (int k = 4; k >= 0; k -= 4) {
      __m512d rows[4];
#pragma GCC unroll 4
      for (int r = 0; r < 4; ++r) {
        const int first = r < 2 ? r : r + 2;  // 0 and 2, 1 and 3, 4 and 6, 5 and 7: lanes come out in order
        const __m256d low = _mm256_load_pd(pieces[piece[first]].a + k);
        const __m256d high = _mm256_load_pd(pieces[piece[first + 2]].a + k);
        rows[r] = _mm512_mask_broadcast_f64x4(_mm512_castpd256_pd512(low), kUpper, high);
      }
      const __m512d even01 = _mm512_maskz_unpacklo_pd(kAll, rows[0], rows[1]);
      const __m512d odd01 = _mm512_maskz_unpackhi_pd(kAll, rows[0], rows[1]);
      const __m512d even23 = _mm512_maskz_unpacklo_pd(kAll, rows[2], rows[3]);
      const __m512d odd23 = _mm512_maskz_unpackhi_pd(kAll, rows[2], rows[3]);
      const __m512d a2 = _mm512_maskz_shuffle_f64x2(kAll, even01, even23, 0xdd);
      const __m512d a3 = _mm512_maskz_shuffle_f64x2(kAll, odd01, odd23, 0xdd);
      const __m512d a0 = _mm512_maskz_shuffle_f64x2(kAll, even01, even23, 0x88);
      const __m512d a1 = _mm512_maskz_shuffle_f64x2(kAll, odd01, odd23, 0x88);
      const __m512d pair = _mm512_add_pd(a2, _mm512_mul_pd(a3, t));
      sum = k == 4 ? pair : _mm512_add_pd(_mm512_mul_pd(sum, t2), pair);
      sum = _mm512_add_pd(_mm512_mul_pd(sum, t2), _mm512_add_pd(a0, _mm512_mul_pd(a1, t)));
    }
    _mm512_storeu_pd(image.value + i, sum);
  }
}

// Which columns of an image are within reach, by a bit each, and the overlaps of all.
struct ReachedColumns {
  std::uint8_t reached[kPairBlock / kPairLanes];
  double value[kPairBlock];
};

// The squares below 1 alone, one after the other; their number with what fills the last eight.
[[MOIRE_AVX512]] std::size_t pack_avx512(std::size_t n, Image& image, ReachedColumns& columns) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < n; i += 8) {
    const __m512d q = _mm512_loadu_pd(image.value + i);
    const __mmask8 reached = _mm512_cmp_pd_mask(q, _mm512_set1_pd(1), _CMP_LT_OQ);
    columns.reached[i / 8] = reached;
    _mm512_storeu_pd(image.value + count, _mm512_maskz_compress_pd(reached, q));  // behind what is still to be read
    count += static_cast<std::size_t>(__builtin_popcount(reached));
  }
  _mm512_storeu_pd(image.value + count, _mm512_set1_pd(1));
  return (count + 7) / 8 * 8;
}

[[MOIRE_AVX512]] void unpack_avx512(std::size_t n, const Image& image, ReachedColumns& columns) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < n; i += 8) {
    const __mmask8 reached = columns.reached[i / 8];
    _mm512_storeu_pd(columns.value + i, _mm512_maskz_expand_pd(reached, _mm512_loadu_pd(image.value + count)));
    count += static_cast<std::size_t>(__builtin_popcount(reached));
  }
}

[[MOIRE_AVX2]] void one_image_avx2(const DiskOverlap& overlap, double scale, double row_x, double row_y,
                                   std::span<const double> x, std::span<const double> y, PairRow& sum) {
  Image image;
  place_one(scale, row_x, row_y, x, y, image);
  look_up<Lanes, LaneMask>(x.size(), image);
  evaluate_avx2(overlap.pieces(), x.size(), image);
  add_one(image, x.size(), sum);
}

[[MOIRE_AVX512]] void one_image_avx512(const DiskOverlap& overlap, double scale, double row_x, double row_y,
                                       std::span<const double> x, std::span<const double> y, PairRow& sum) {
  Image image;
  place_one(scale, row_x, row_y, x, y, image);
  look_up<WideLanes, WideLaneMask>(x.size(), image);
  evaluate_avx512(overlap.pieces(), x.size(), image);
  add_one(image, x.size(), sum);
}

[[MOIRE_AVX2]] void four_images_avx2(const DiskOverlap& overlap, double scale, double row_x, double row_y,
                                     std::span<const double> x, std::span<const double> y, PairRow& sum) {
  Image image[4];
  place_four(scale, row_x, row_y, x, y, image);
  for (Image& each : image) {
    look_up<Lanes, LaneMask>(x.size(), each);
    evaluate_avx2(overlap.pieces(), x.size(), each);
  }
  add_four(image, image[1].value, x.size(), sum);
}

[[MOIRE_AVX512]] void four_images_avx512(const DiskOverlap& overlap, double scale, double row_x, double row_y,
                                         std::span<const double> x, std::span<const double> y, PairRow& sum) {
  Image image[4];
  place_four(scale, row_x, row_y, x, y, image);
  ReachedColumns farthest;
  const std::size_t reached = pack_avx512(x.size(), image[1], farthest);
  for (Image& each : image) {
    const std::size_t n = &each == &image[1] ? reached : x.size();
    look_up<WideLanes, WideLaneMask>(n, each);
    evaluate_avx512(overlap.pieces(), n, each);
  }
  unpack_avx512(x.size(), image[1], farthest);
  add_four(image, farthest.value, x.size(), sum);
}

constexpr DiskTerms kOneImage[] = {one_image_plain, one_image_avx2, one_image_avx512};
constexpr DiskTerms kFourImages[] = {four_images_plain, four_images_avx2, four_images_avx512};
#else
constexpr DiskTerms kOneImage[] = {one_image_plain};
constexpr DiskTerms kFourImages[] = {four_images_plain};
#endif

}  // namespace

std::span<const DiskTerms> disk_terms() { return std::span<const DiskTerms>(kFourImages, usable_sets()); }
std::span<const DiskTerms> disk_terms_of_one_image() { return std::span<const DiskTerms>(kOneImage, usable_sets()); }

}  // namespace moire
