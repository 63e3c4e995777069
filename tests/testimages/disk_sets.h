// Random sets of disjoint disks of many sizes, the same on every machine.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

#include "testimages/circle.h"

namespace moire::test {

// std::uniform_* differ between libraries; tests must not.
class Random {
 public:
  explicit Random(std::uint64_t seed) : bits_(seed) {}
  double uniform(double lo, double hi) { return lo + (hi - lo) * (static_cast<double>(bits_() >> 11) * 0x1p-53); }
  double log_uniform(double lo, double hi) { return std::exp(uniform(std::log(lo), std::log(hi))); }
  // 0 <= result < n.
  std::size_t below(std::size_t n) { return static_cast<std::size_t>(bits_() % n); }

 private:
  std::mt19937_64 bits_;
};

// `count` disks, each alone in its square of a quadtree over [0, side)^2. `depth` 0: squares of all places are divided
// alike; towards 1: always one of the latest, so that sizes fall by halves around a few points. `fill`: the radius as a
// share of half the square, at most this; 1 in dyadic squares makes disks that touch.
inline std::vector<GivenCircle> random_disks(Random& random, std::size_t count, double side, double depth,
                                             double fill) {
  struct Square {
    double x, y, side;
  };
  std::vector<Square> squares{{0, 0, side}};
  while (squares.size() < count) {
    std::size_t i = random.below(squares.size());
    if (random.uniform(0, 1) < depth) i = squares.size() - 1 - random.below(std::min<std::size_t>(squares.size(), 4));
    const Square s = squares[i];
    if (s.side < side * 0x1p-40) continue;
    const double half = s.side / 2;
    squares[i] = {s.x, s.y, half};
    squares.push_back({s.x + half, s.y, half});
    squares.push_back({s.x, s.y + half, half});
    squares.push_back({s.x + half, s.y + half, half});
  }
  squares.resize(count);
  std::vector<GivenCircle> disks;
  for (const Square& s : squares) {
    const double radius = s.side / 2 * (fill == 1 ? 1 : random.uniform(0.01, fill));
    disks.push_back({{s.x + s.side / 2, s.y + s.side / 2}, radius});
  }
  return disks;
}

// x, y, radius of each, as a scene file lists them.
inline std::vector<double> rows_of(const std::vector<GivenCircle>& disks) {
  std::vector<double> rows;
  for (const GivenCircle& d : disks) rows.insert(rows.end(), {d.center.x, d.center.y, d.radius});
  return rows;
}

}  // namespace moire::test
