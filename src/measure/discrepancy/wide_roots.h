// Square roots by Newton's iteration with AVX-512, rounded as the machine's own: those come out of one unit that takes
// three cycles a root, and this keeps two units busy for less than half of that. After P. Markstein, "Computation of
// elementary functions on the IBM RISC System/6000 processor", IBM J. Res. Dev. 34, 1990, but with a check in place of
// his proof, because first approximations differ from maker to maker.
#pragma once

#include "core/instruction_sets.h"

#if MOIRE_HAS_AVX
#include <immintrin.h>

#include <cstddef>

namespace moire {

// root[i] = sqrt(a[i]) for numbers a >= 0, the same bits as IEEE 754's. Several at a time: one waits for itself.
//
// The instruction's y is 1/sqrt(a) within 2^-14 of it; one step makes h = 1/(2 sqrt a) good to 2^-26, and a second one
// the root g to 2^-50. Then sqrt(a) = g + h (a - g^2) (1 + c) with |c| < 2^-25, so that it lies between the two sums
// that are made with a little more and a little less than h. Where both round to one number that is the root: rounding
// is monotonic. They do but for one in 2^24. Where they do not, near 0 (there a - g^2 may underflow) and at 0 (y is
// infinite, and a comparison of what is no number is false) the machine's instruction is taken.
template <std::size_t kCount>
[[MOIRE_AVX512]] [[gnu::always_inline]] inline void square_roots(const __m512d (&a)[kCount], __m512d (&root)[kCount]) {
  constexpr __mmask8 kAll = 0xff;  // forms with a mask, because GCC 12 warns of the others
  const __m512d half = _mm512_set1_pd(0.5), least = _mm512_set1_pd(0x1p-900);
  const __m512d more = _mm512_set1_pd(1 + 0x1p-24), less = _mm512_set1_pd(1 - 0x1p-24);
  __mmask8 sure = kAll;
  // Each step for all of them, because compilers keep the order they are given.
  __m512d g[kCount], h[kCount], rest[kCount];
#pragma GCC unroll 8
  for (std::size_t i = 0; i < kCount; ++i) {
    const __m512d y = _mm512_maskz_rsqrt14_pd(kAll, a[i]);
    g[i] = _mm512_mul_pd(a[i], y);
    h[i] = _mm512_mul_pd(half, y);
  }
#pragma GCC unroll 8
  for (std::size_t i = 0; i < kCount; ++i) {
    const __m512d off = _mm512_fnmadd_pd(g[i], h[i], half);
    g[i] = _mm512_fmadd_pd(g[i], off, g[i]);
    h[i] = _mm512_fmadd_pd(h[i], off, h[i]);
  }
#pragma GCC unroll 8
  for (std::size_t i = 0; i < kCount; ++i) {
    g[i] = _mm512_fmadd_pd(_mm512_fnmadd_pd(g[i], g[i], a[i]), h[i], g[i]);
  }
#pragma GCC unroll 8
  for (std::size_t i = 0; i < kCount; ++i) {
    rest[i] = _mm512_fnmadd_pd(g[i], g[i], a[i]);
    root[i] = _mm512_fmadd_pd(rest[i], _mm512_mul_pd(h[i], more), g[i]);
    const __m512d other = _mm512_fmadd_pd(rest[i], _mm512_mul_pd(h[i], less), g[i]);
    sure = _mm512_mask_cmp_pd_mask(sure, root[i], other, _CMP_EQ_OQ);
    sure = _mm512_mask_cmp_pd_mask(sure, a[i], least, _CMP_GT_OQ);
  }
  if (sure == kAll) [[likely]]
    return;
  for (std::size_t i = 0; i < kCount; ++i) root[i] = _mm512_maskz_sqrt_pd(kAll, a[i]);
}

}  // namespace moire
#endif
