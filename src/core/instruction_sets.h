// Loops compiled for several instruction sets, of which the machine's best is taken at run time. Without contraction
// and reordering they give the same bits on each.
//
// How: the loop is a [[gnu::always_inline]] function; one function for each set calls it, with these attributes; a
// table of them, plainest first, is cut off behind usable_sets().
#pragma once

#include <cstddef>

#if defined(__x86_64__)
#define MOIRE_HAS_AVX 1
#define MOIRE_AVX2 gnu::target("avx2")
#if defined(__clang__)
#define MOIRE_AVX512 gnu::target("avx512f,avx512dq,avx512vl,avx512bw")
#else
#define MOIRE_AVX512 gnu::target("avx512f,avx512dq,avx512vl,avx512bw,prefer-vector-width=512")
#endif
#else
#define MOIRE_HAS_AVX 0
#endif

namespace moire {

// How many of {plain, AVX2, AVX-512} this machine can run.
inline std::size_t usable_sets() noexcept {
#if MOIRE_HAS_AVX
  if (!__builtin_cpu_supports("avx2")) return 1;
  const bool wide = __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
                    __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512bw");
  return wide ? 3 : 2;
#else
  return 1;
#endif
}

}  // namespace moire
