// Chebyshev series of many polynomials that are derived from one, and their values at one place.
#pragma once

#include <cstddef>

#include "testimages/euler_polynomials.h"

namespace moire {

// out = f', both Chebyshev series of n coefficients.
template <class T>
void derive(const T* f, std::size_t n, T* out) {
  T next = 0.0, after = 0.0;  // out[k + 1], out[k + 2]
  for (std::size_t k = n; k-- > 0;) {
    const T d = k + 1 < n ? after + T(2 * static_cast<double>(k + 1)) * f[k + 1] : T(0.0);
    out[k] = d;
    after = next;
    next = d;
  }
  out[0] = T(0.5) * out[0];
}

template <class T>
T clenshaw(const T* c, std::size_t n, T t) {
  T b1 = 0.0, b2 = 0.0;
  for (std::size_t k = n; k-- > 1;) {
    const T b = c[k] + (T(2.0) * t * b1 - b2);
    b2 = b1;
    b1 = b;
  }
  return c[0] + (t * b1 - b2);
}

// Many series, at most kMaxTerms + 1, at one t: out[k] for k < count, coefficient i of series k at c[i stride + k]. The
// same bits as one by one, but no step waits for the one before it.
inline void clenshaw(const double* c, std::size_t n, std::size_t stride, std::size_t count, double t, double* out) {
  double b1[kMaxTerms + 1] = {}, b2[kMaxTerms + 1] = {};
  for (std::size_t i = n; i-- > 1;) {
    for (std::size_t k = 0; k < count; ++k) {
      const double b = c[i * stride + k] + (2 * t * b1[k] - b2[k]);
      b2[k] = b1[k];
      b1[k] = b;
    }
  }
  for (std::size_t k = 0; k < count; ++k) out[k] = c[k] + (t * b1[k] - b2[k]);
}

}  // namespace moire
