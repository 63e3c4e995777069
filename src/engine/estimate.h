// What an estimator makes of a pixel's sums.
#pragma once

#include "engine/cell_sums.h"
#include "engine/render.h"

namespace moire {

struct Estimate {
  double value = 0;
  bool fallback = false;
};

// `sums` over all samples that the window touches, rho samples a pixel; own_mean() is asked only where it counts.
template <class Mean>
Estimate estimate(Estimator estimator, const WeightSum& sums, double rho, const Mean& own_mean) {
  // Adding +0.0 turns a negative zero, from a negative lobe, into a positive one.
  if (estimator == Estimator::unnormalised) return {sums.kf / rho + 0.0, false};
  if (estimator == Estimator::ratio && sums.k >= rho / 4) return {sums.kf / sums.k + 0.0, false};
  const double mean = own_mean();
  return {mean + (sums.kf - mean * sums.k) / rho + 0.0, estimator == Estimator::ratio};
}

}  // namespace moire
