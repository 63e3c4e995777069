// The error of an image against its exact values, in numbers: bias, mean errors, the worst pixel and percentiles.
// error = got - want, in double and in units of coverage (0 to 1).
#pragma once

#include <cstdint>
#include <vector>

#include "core/sum.h"

namespace moire {

// Half a step of an 8-bit image: an error above it may show.
inline constexpr double kTolerance = 0.5 / 255.0;

// Errors over one region. Means, maximum and percentiles are over the n_pixels - nan_count pixels whose error is a
// finite number; where there are none they are NaN.
struct Errors {
  std::int64_t n_pixels = 0;
  std::int64_t nan_count = 0;          // pixels whose error is NaN or infinite
  std::int64_t outside_tolerance = 0;  // pixels with |error| > kTolerance
  double bias = 0;                     // mean error
  double mae = 0;                      // mean |error|
  double mse = 0, rmse = 0;            // mean squared error and its root
  double max_abs = 0;
  // The worst pixel, the first in row-major order of several; -1 and NaN where no pixel is wrong.
  std::int64_t max_x = -1, max_y = -1;
  double max_got = 0, max_want = 0;
  // Percentiles of |error|, nearest rank: the smallest |error| that at least p per cent of the pixels do not exceed.
  double p50 = 0, p90 = 0, p95 = 0, p99 = 0, p995 = 0;
};

// Collects errors pixel by pixel. Pixels known to be exact need only be counted: doing so gives the same bits in every
// field as adding them one by one with got = want. Keeps 8 bytes for each pixel that is wrong.
class ErrorTally {
 public:
  // Rows from top to bottom, pixels in any gaps but in row-major order: each row has its own compensated sums, added in
  // row order, and the order decides which of several worst pixels is named.
  void add(std::int64_t x, std::int64_t y, double got, double want);
  // Pixels whose error is exactly 0, wherever they lie.
  void add_exact(std::int64_t count) noexcept { exact_ += count; }

  Errors finish() const;

 private:
  struct Sums {
    Sum error, abs, squared;
  };
  static void fold(const Sums& row, Sums& total) noexcept;

  Sums total_, row_;
  std::int64_t row_y_ = 0;
  std::int64_t exact_ = 0, nan_ = 0, outside_ = 0;
  std::vector<double> abs_;  // |error| of the pixels that are wrong
  double max_abs_ = 0, max_got_ = 0, max_want_ = 0;
  std::int64_t max_x_ = -1, max_y_ = -1;
};

}  // namespace moire
