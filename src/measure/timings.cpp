// What repeated timings of one piece of work say.
#include "measure/timings.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace moire {
namespace {

// At least one value, in rising order.
double middle(const std::vector<double>& sorted) {
  const std::size_t half = sorted.size() / 2;
  return sorted.size() % 2 == 1 ? sorted[half] : (sorted[half - 1] + sorted[half]) / 2;
}

}  // namespace

TimingSpread timing_spread(std::span<const double> timings) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  if (timings.empty()) return {kNan, kNan, kNan, kNan};
  std::vector<double> sorted(timings.begin(), timings.end());
  std::sort(sorted.begin(), sorted.end());
  TimingSpread spread{middle(sorted), 0, sorted.front(), sorted.back()};
  for (double& value : sorted) value = std::fabs(value - spread.median);
  std::sort(sorted.begin(), sorted.end());
  spread.deviation = middle(sorted);
  return spread;
}

}  // namespace moire
