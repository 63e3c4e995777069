// What nothing else beats in both cost and error.
#include "measure/pareto_front.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

namespace moire {

std::vector<bool> pareto_front(std::span<const CostError> points) {
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (std::isfinite(points[i].cost) && std::isfinite(points[i].error)) order.push_back(i);
  }
  const auto key = [&](std::size_t i) { return std::tuple(points[i].cost, points[i].error); };
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return key(a) < key(b); });
  std::vector<bool> front(points.size());
  double least = std::numeric_limits<double>::infinity();  // error of what costs no more
  const CostError* last = nullptr;                         // the front's last point
  for (const std::size_t i : order) {
    const CostError& p = points[i];
    const bool again = last != nullptr && p.cost == last->cost && p.error == last->error;
    if (p.error >= least && !again) continue;
    front[i] = true;
    least = p.error;
    last = &p;
  }
  return front;
}

}  // namespace moire
