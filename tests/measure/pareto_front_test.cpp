// The Pareto front against its definition.
#include "measure/pareto_front.h"

#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

using namespace moire;

namespace {

bool is_finite(const CostError& p) { return std::isfinite(p.cost) && std::isfinite(p.error); }

bool beats(const CostError& a, const CostError& b) {
  return a.cost <= b.cost && a.error <= b.error && (a.cost < b.cost || a.error < b.error);
}

std::vector<bool> by_definition(const std::vector<CostError>& points) {
  std::vector<bool> front;
  for (const CostError& p : points) {
    bool beaten = !is_finite(p);
    for (const CostError& q : points) beaten |= is_finite(q) && beats(q, p);
    front.push_back(!beaten);
  }
  return front;
}

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("the front has what nothing beats, and equal points are in together") {
    const std::vector<CostError> points = {{1, 8}, {2, 4}, {3, 5}, {2, 4}, {2, 6}, {4, 4}, {5, 1}, {6, 1}};
    CHECK(pareto_front(points) == std::vector<bool>{true, true, false, true, false, false, true, false});
    CHECK(pareto_front({}).empty());
    CHECK(pareto_front(std::vector<CostError>{{3, 3}}) == std::vector<bool>{true});
  }

  TEST_CASE("points that are no numbers are out and beat nobody") {
    const double nan = std::nan(""), inf = std::numeric_limits<double>::infinity();
    CHECK(pareto_front(std::vector<CostError>{{nan, 1}, {2, 2}, {1, nan}, {-inf, 0}, {3, inf}}) ==
          std::vector<bool>{false, true, false, false, false});
  }

  TEST_CASE("the front is that of the definition for many sets with many ties") {
    std::uint64_t state = 1;
    const auto next = [&](int range) {
      state = state * 6364136223846793005u + 1442695040888963407u;
      return static_cast<double>((state >> 33) % static_cast<std::uint64_t>(range));
    };
    for (int set = 0; set < 500; ++set) {
      std::vector<CostError> points;
      const int count = set % 40;
      for (int i = 0; i < count; ++i) points.push_back({next(2 + set % 30), next(2 + set % 20)});
      CAPTURE(set);
      CHECK(pareto_front(points) == by_definition(points));
    }
  }
}
