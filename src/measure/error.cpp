// The error of an image in numbers, pixel by pixel.
#include "measure/error.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

namespace moire {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

// Nearest rank at `per_mille` of `zeros` zeros and the values, which it reorders; count = zeros + values.size() > 0.
double percentile(std::int64_t zeros, std::span<double> values, std::int64_t per_mille) {
  const std::int64_t count = zeros + static_cast<std::int64_t>(values.size());
  // ceil(count per_mille / 1000) without leaving 64 bits.
  const std::int64_t rank = count / 1000 * per_mille + (count % 1000 * per_mille + 999) / 1000;
  if (rank <= zeros) return 0;
  const auto nth = values.begin() + static_cast<std::ptrdiff_t>(rank - zeros - 1);
  std::nth_element(values.begin(), nth, values.end());
  return *nth;
}

}  // namespace

void ErrorTally::fold(const Sums& row, Sums& total) noexcept {
  total.error.add(row.error.value());
  total.abs.add(row.abs.value());
  total.squared.add(row.squared.value());
}

void ErrorTally::add(std::int64_t x, std::int64_t y, double got, double want) {
  const double error = got - want;
  if (!std::isfinite(error)) {
    ++nan_;
    return;
  }
  // An exact pixel must leave no trace but its count: it would be skipped elsewhere.
  if (error == 0) {
    ++exact_;
    return;
  }
  if (y != row_y_) {
    fold(row_, total_);
    row_ = {};
    row_y_ = y;
  }
  const double size = std::fabs(error);
  row_.error.add(error);
  row_.abs.add(size);
  row_.squared.add(error * error);
  abs_.push_back(size);
  if (size > kTolerance) ++outside_;
  if (size > max_abs_) {
    max_abs_ = size;
    max_x_ = x;
    max_y_ = y;
    max_got_ = got;
    max_want_ = want;
  }
}

Errors ErrorTally::finish() const {
  Errors e;
  const std::int64_t counted = exact_ + static_cast<std::int64_t>(abs_.size());
  e.n_pixels = counted + nan_;
  e.nan_count = nan_;
  e.outside_tolerance = outside_;
  e.max_got = e.max_want = kNan;
  if (counted == 0) {
    e.bias = e.mae = e.mse = e.rmse = e.max_abs = kNan;
    e.p50 = e.p90 = e.p95 = e.p99 = e.p995 = kNan;
    return e;
  }
  Sums total = total_;
  fold(row_, total);
  const double n = static_cast<double>(counted);
  e.bias = total.error.value() / n;
  e.mae = total.abs.value() / n;
  e.mse = total.squared.value() / n;
  e.rmse = std::sqrt(e.mse);
  if (max_abs_ > 0) {
    e.max_abs = max_abs_;
    e.max_x = max_x_;
    e.max_y = max_y_;
    e.max_got = max_got_;
    e.max_want = max_want_;
  }
  std::vector<double> sizes = abs_;
  e.p50 = percentile(exact_, sizes, 500);
  e.p90 = percentile(exact_, sizes, 900);
  e.p95 = percentile(exact_, sizes, 950);
  e.p99 = percentile(exact_, sizes, 990);
  e.p995 = percentile(exact_, sizes, 995);
  return e;
}

}  // namespace moire
