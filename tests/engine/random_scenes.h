// Random scenes whose boundary crosses the window of a given pixel. The same numbers on every machine.
#pragma once

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "scenes.h"
#include "stress/views.h"

namespace moire {

// std::uniform_* differ between libraries; tests must not.
class Draw {
 public:
  explicit Draw(std::uint64_t seed) : random_(seed) {}
  double uniform(double lo, double hi) { return lo + (hi - lo) * (static_cast<double>(random_() >> 11) * 0x1p-53); }
  double log_uniform(double lo, double hi) { return std::exp(uniform(std::log(lo), std::log(hi))); }
  // lo <= result <= hi.
  std::int64_t integer(std::int64_t lo, std::int64_t hi) {
    return lo + static_cast<std::int64_t>(random_() % static_cast<std::uint64_t>(hi - lo + 1));
  }
  bool coin() { return (random_() & 1) != 0; }

 private:
  std::mt19937_64 random_;
};

struct RandomCase {
  TestImage image;
  Pixel pixel;
};

// A point of the window of half width `reach` around the pixel's centre.
inline Vec2 point_in_window(Draw& draw, Pixel p, double reach) {
  return {static_cast<double>(p.x) + 0.5 + draw.uniform(-reach, reach),
          static_cast<double>(p.y) + 0.5 + draw.uniform(-reach, reach)};
}

inline Pixel random_pixel(Draw& draw) { return {draw.integer(-4096, 4096), draw.integer(-4096, 4096)}; }

inline RandomCase random_edge(Draw& draw, double reach) {
  const Pixel p = random_pixel(draw);
  const double angle = draw.uniform(0, 2 * std::numbers::pi), length = draw.log_uniform(1e-3, 1e3);
  const Vec2 through = point_in_window(draw, p, reach);
  return {scenes::edge(through, {length * std::cos(angle), length * std::sin(angle)}), p};
}

// Radius log-uniform from 1e-6 to 1e9 pixels; the circle passes through the window up to the rounding of its centre.
inline RandomCase random_disk(Draw& draw, double reach) {
  const Pixel p = random_pixel(draw);
  const double angle = draw.uniform(0, 2 * std::numbers::pi), r = draw.log_uniform(1e-6, 1e9);
  const Vec2 on = point_in_window(draw, p, reach);
  return {scenes::disk({on.x - r * std::cos(angle), on.y - r * std::sin(angle)}, r), p};
}

using scenes::look;
using scenes::Seen;

// A finite board through a camera of any pitch, yaw and roll, a mirrored camera or a raw homography. A grid line of
// the board, or its rim, passes through the pixel `offset` away; the window of half width `reach` holds up to about
// `cells` squares.
inline RandomCase random_board(Draw& draw, double reach, double cells) {
  for (;;) {
    std::vector<double> h;
    scenes::Camera camera;
    const int way = static_cast<int>(draw.integer(0, 2));
    Vec2 p{draw.uniform(-500, 1500), draw.uniform(-500, 1500)};
    if (way < 2) {
      camera = {draw.log_uniform(100, 2000), {draw.uniform(0, 1000), draw.uniform(0, 1000)},
                draw.log_uniform(0.2, 20),   draw.uniform(-60, 80),
                draw.uniform(-180, 180),     draw.uniform(-180, 180)};
      h = scenes::homography_of(camera);
      if (way == 1)
        for (std::size_t i = 0; i < 9; i += 3) h[i] = -h[i];
    } else {
      for (int i = 0; i < 9; ++i) h.push_back(draw.uniform(-1, 1) * (i < 6 ? 1 : i < 8 ? 1e-3 : 1));
    }
    const Seen at = look(h, p), right = look(h, {p.x + 1, p.y}), below = look(h, {p.x, p.y + 1});
    if (at.w <= 0 || right.w <= 0 || below.w <= 0) continue;
    const double du = std::fabs(right.u - at.u) + std::fabs(below.u - at.u);
    const double dv = std::fabs(right.v - at.v) + std::fabs(below.v - at.v);
    if (4 * reach * reach * du * dv > cells || std::max(du, dv) * 2 * reach > cells) continue;
    if (std::max(du, dv) < 0.01 || std::fabs(at.u) > 1e4 || std::fabs(at.v) > 1e4) continue;
    // Move to the nearest grid line, in the direction of faster change, by Newton's method.
    const bool along_u = du > dv;
    const double line = std::round(along_u ? at.u : at.v);
    bool found = true;
    for (int step = 0; step < 6 && found; ++step) {
      const Seen s = look(h, p), sx = look(h, {p.x + 1e-3, p.y}), sy = look(h, {p.x, p.y + 1e-3});
      const double miss = line - (along_u ? s.u : s.v);
      const double gx = ((along_u ? sx.u - s.u : sx.v - s.v)) * 1e3, gy = ((along_u ? sy.u - s.u : sy.v - s.v)) * 1e3;
      const double scale = miss / (gx * gx + gy * gy);
      p = {p.x + gx * scale, p.y + gy * scale};
      found =
          std::isfinite(p.x) && std::isfinite(p.y) && look(h, p).w > 0 && std::fabs(p.x) < 1e5 && std::fabs(p.y) < 1e5;
    }
    if (!found) continue;
    const Seen hit = look(h, p);
    // Whole and broken rims, sometimes through the window.
    const auto rim = [&](double centre, double span) {
      const double r = draw.uniform(0.2, span);
      return draw.coin() ? std::floor(centre + r) : centre + r;
    };
    const double span = 2 + 2 * reach * std::max(du, dv);
    const std::vector<double> extent{std::min(rim(hit.u, span) - span - 1, std::floor(hit.u)), rim(hit.u, span) + 1,
                                     std::min(rim(hit.v, span) - span - 1, std::floor(hit.v)), rim(hit.v, span) + 1};
    const int shift = static_cast<int>(reach);
    const Pixel pixel{static_cast<std::int64_t>(std::floor(p.x)) + draw.integer(-shift, shift),
                      static_cast<std::int64_t>(std::floor(p.y)) + draw.integer(-shift, shift)};
    return {way == 0 ? scenes::board(camera, extent) : scenes::board(h, extent), pixel};
  }
}

}  // namespace moire
