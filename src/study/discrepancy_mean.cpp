// Means of a discrepancy over sets of points.
#include "study/discrepancy_mean.h"

#include <cmath>
#include <utility>

#include "core/sum.h"

namespace moire {
namespace {

// The mean of f over the values, and its standard error.
template <class F>
std::pair<double, double> mean_and_error(const std::vector<double>& values, F&& f) {
  const auto n = static_cast<double>(values.size());
  Sum sum, squares;
  for (const double v : values) sum.add(f(v));
  const double mean = sum.value() / n;
  for (const double v : values) squares.add((f(v) - mean) * (f(v) - mean));
  return {mean, std::sqrt(squares.value() / (n - 1) / n)};
}

}  // namespace

DiscrepancyMean mean_over_sets(const std::vector<double>& values) {
  const auto [mean, error] = mean_and_error(values, [](double v) { return v; });
  const auto [square, square_error] = mean_and_error(values, [](double v) { return v * v; });
  return {mean, std::sqrt(square), error, square_error};
}

}  // namespace moire
