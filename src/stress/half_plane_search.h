// The L-infinity discrepancy of half-planes by brute force over critical lines, in 113 bits.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "oracle/quad.h"
#include "stress/weighted_points.h"

namespace moire::stress {

// The largest |share of the points - area| over half-planes. Complements turn signs, so that closed half-planes with
// too many points are enough; such a one may be turned and moved until its line goes through two points, or through one
// in the middle of its chord, where turning no longer lessens the area, or along a side. O(places^3).
//
// Points within kNear of a line count as on it: that moves no half-plane by more, so the error stays below 2^-97.
class HalfPlaneSearch {
 public:
  using Quad = oracle::Quad;
  static constexpr double kError = 0x1p-97;

  explicit HalfPlaneSearch(const WeightedPoints& w) : w_(w), n_(static_cast<Quad>(w.points())) {}

  Quad worst() {
    for (std::size_t i = 0; i < w_.places(); ++i) {
      const Quad x = oracle::widen(w_.x[i]), y = oracle::widen(w_.y[i]);
      for (std::size_t j = 0; j < i; ++j) see(x, y, oracle::widen(w_.x[j]) - x, oracle::widen(w_.y[j]) - y);
      see(x, y, 1, 0);
      see(x, y, 0, 1);
      // The point halves the chord that cuts a corner off at twice its distances from the sides.
      const Quad across = oracle::min(x, 1 - x), down = oracle::min(y, 1 - y);
      see(x, y, across, x < 1 - x ? -(y < 1 - y ? down : -down) : (y < 1 - y ? down : -down));
      // Where x or y is 1/2, two corners are alike.
      see(x, y, across, down);
      see(x, y, across, -down);
    }
    return worst_;
  }

 private:
  // Both sides of the line through (x, y) along (dx, dy).
  void see(Quad x, Quad y, Quad dx, Quad dy) {
    constexpr double kNear = 0x1p-100;
    const Quad scale = oracle::max(oracle::abs(dx), oracle::abs(dy));
    if (scale == 0) return;
    dx /= scale;
    dy /= scale;
    const Quad length = oracle::sqrt(dx * dx + dy * dy);
    dx /= length;
    dy /= length;
    std::uint64_t left = 0, right = 0;
    for (std::size_t k = 0; k < w_.places(); ++k) {
      const Quad side = dx * (oracle::widen(w_.y[k]) - y) - dy * (oracle::widen(w_.x[k]) - x);
      if (side >= -oracle::widen(kNear)) left += w_.count[k];
      if (side <= oracle::widen(kNear)) right += w_.count[k];
    }
    const Quad area = area_left(x, y, dx, dy);
    worst_ = oracle::max(worst_, static_cast<Quad>(left) / n_ - area);
    worst_ = oracle::max(worst_, static_cast<Quad>(right) / n_ - (1 - area));
  }

  // Of the unit square: its corners on that side and where its sides cross the line.
  static Quad area_left(Quad x, Quad y, Quad dx, Quad dy) {
    constexpr int kX[] = {0, 1, 1, 0}, kY[] = {0, 0, 1, 1};
    std::array<Quad, 4> side;
    for (std::size_t c = 0; c < 4; ++c) side[c] = dx * (kY[c] - y) - dy * (kX[c] - x);
    std::vector<oracle::Point> polygon;
    for (std::size_t c = 0; c < 4; ++c) {
      const std::size_t next = (c + 1) % 4;
      if (side[c] >= 0) polygon.push_back({static_cast<Quad>(kX[c]), static_cast<Quad>(kY[c])});
      if ((side[c] > 0 && side[next] < 0) || (side[c] < 0 && side[next] > 0)) {
        const Quad s = side[c] / (side[c] - side[next]);
        polygon.push_back({kX[c] + s * (kX[next] - kX[c]), kY[c] + s * (kY[next] - kY[c])});
      }
    }
    Quad twice = 0;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const oracle::Point &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
      twice += a.x * b.y - a.y * b.x;
    }
    return twice / 2;
  }

  const WeightedPoints& w_;
  Quad n_, worst_ = 0;
};

}  // namespace moire::stress
