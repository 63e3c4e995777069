// Windows that are short sums of cosines, on [-1, 1]: a[0] + a[1] cos(pi t) + a[2] cos(2 pi t) + ...
//
// Harris, "On the use of windows for harmonic analysis with the discrete Fourier transform", Proc. IEEE 66(1), 1978.
#pragma once

#include <span>

#include "core/dd_math.h"
#include "filters/ellipse.h"

namespace moire {

// The minimum four-term window of Harris's table: side lobes below -92 dB.
inline constexpr double kBlackmanHarris[] = {0.35875, 0.48829, 0.14128, 0.01168};

// By the Chebyshev recurrence in cos(pi t): one cosine. |t| <= 1.
inline Dd cosine_sum(std::span<const double> a, Dd t) {
  const Dd c = dd_cos_pi(t);
  Dd sum = a[0], before = 1.0, now = c;
  for (std::size_t m = 1; m < a.size(); ++m) {
    sum = sum + Dd(a[m]) * now;
    const Dd next = Dd(2) * c * now - before;
    before = now;
    now = next;
  }
  return sum;
}

// Bound on it for |Im t| <= height; all a[m] >= 0.
inline double cosine_sum_bound(std::span<const double> a, double height) {
  double sum = 0;
  for (std::size_t m = 0; m < a.size(); ++m) sum += a[m] * cos_pi_bound(static_cast<double>(m) * height);
  return sum;
}

}  // namespace moire
