// Star discrepancy in the plane by a sweep over x with the heights of the points so far in order.
#include "measure/discrepancy/star_linf.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <vector>

namespace moire {
namespace {

// What is fullest and what is emptiest for the first `count` points of the sweep, in points: count - area * N at its
// most and area * N - count at its most. Fullest are closed boxes that end in the last point's x = `left` and in a
// height h[k], k = 1 to count, which hold at least k points; emptiest are open ones that end in the next point's x =
// `right` and in the height h[k + 1], and hold at most k points. Where points share an x or a height, some boxes hold
// more, or fewer, than that; what they are given is then too little, and a box of the same extent, with the last or the
// first of the tied points, is given its due.
double extreme(const std::vector<double>& heights, std::size_t count, double left, double right) {
  // Eight maxima side by side, for vector registers; and numbers of points as int, because SSE2 converts no other
  // integers.
  constexpr std::size_t kLanes = 8;
  std::array<double, kLanes> most{};
  const double* const h = heights.data();  // h[0] = 0, then the points', then 1
  const auto see = [&](std::size_t k, double number, std::size_t lane) {
    const double full = number - left * h[k], empty = right * h[k + 1] - number;
    const double larger = full > empty ? full : empty;
    most[lane] = larger > most[lane] ? larger : most[lane];
  };
  std::size_t k = 0;
  for (; k + kLanes <= count + 1; k += kLanes)
    for (std::size_t lane = 0; lane < kLanes; ++lane)
      see(k + lane, static_cast<double>(static_cast<int>(k + lane)), lane);
  for (; k <= count; ++k) see(k, static_cast<double>(k), 0);
  return *std::max_element(most.begin(), most.end());
}

}  // namespace

double star_linf(const PointView& points) {
  const std::size_t n = points.size();
  std::vector<std::size_t> order(n);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return points.x[a] < points.x[b]; });

  const auto scale = static_cast<double>(n);
  std::vector<double> heights{0.0, 1.0};
  heights.reserve(n + 2);
  double most = 0, left = 0;
  for (std::size_t i = 0; i <= n; ++i) {
    const double right = i < n ? points.x[order[i]] : 1.0;
    most = std::max(most, extreme(heights, i, scale * left, scale * right));
    if (i == n) break;
    const double y = points.y[order[i]];
    heights.insert(std::upper_bound(heights.begin() + 1, heights.end() - 1, y), y);
    left = right;
  }
  return most / scale;
}

}  // namespace moire
