// What the cases of one scene and filter share: the active pixels and their exact values.
#include "study/truth.h"

#include <utility>

#include "study/stopwatch.h"

namespace moire {
namespace {

std::vector<std::uint8_t> horizon_pixels(const TestImage& scene, const Filter& filter, const ActiveRows& rows) {
  if (scene.info().meets_horizon == nullptr) return {};
  std::vector<std::uint8_t> horizon;
  bool any = false;
  const double r = filter.radius();
  for_each_active(rows, [&](int x, int y, std::int64_t) {
    horizon.push_back(scene.meets_horizon({x, y}, {{0.5 - r, 0.5 - r}, {0.5 + r, 0.5 + r}}));
    any |= horizon.back() != 0;
  });
  return any ? horizon : std::vector<std::uint8_t>{};
}

}  // namespace

Truth find_truth(const TestImage& scene, const Filter& filter, const WeightAim& aim) {
  const Stopwatch time;
  ActiveRows rows = enumerate(scene, filter.radius());
  Reference reference = exact(scene, filter, rows, aim);
  std::vector<std::uint8_t> horizon = horizon_pixels(scene, filter, rows);
  return {std::move(rows), std::move(reference), std::move(horizon), time.nanoseconds()};
}

}  // namespace moire
