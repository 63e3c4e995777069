// Textbook coverage; see naive.h.
#include "stress/naive.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace moire::stress {
namespace {

using Corners = std::vector<Vec2>;

Corners window(Pixel pixel, double width) {
  const double x = static_cast<double>(pixel.x) + 0.5, y = static_cast<double>(pixel.y) + 0.5, h = width / 2;
  return {{x - h, y - h}, {x + h, y - h}, {x + h, y + h}, {x - h, y + h}};
}

// The part of a convex polygon where signed(p) >= 0.
template <class F>
Corners clipped(const Corners& polygon, const F& signed_distance) {
  Corners out;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 p = polygon[i], q = polygon[(i + 1) % polygon.size()];
    const double a = signed_distance(p), b = signed_distance(q);
    if (a >= 0) out.push_back(p);
    if ((a >= 0) == (b >= 0)) continue;
    const double t = a / (a - b);
    out.push_back({p.x + t * (q.x - p.x), p.y + t * (q.y - p.y)});
  }
  return out;
}

double area(const Corners& polygon) {
  double twice = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 p = polygon[i], q = polygon[(i + 1) % polygon.size()];
    twice += p.x * q.y - p.y * q.x;
  }
  return std::fabs(twice) / 2;
}

// The disk's area left of x and below y, from its centre.
double quarter_plane(double r, double x, double y) {
  const auto half_chords = [r](double a) { return 0.5 * (a * std::sqrt(r * r - a * a) + r * r * std::asin(a / r)); };
  x = std::clamp(x, -r, r);
  y = std::clamp(y, -r, r);
  // Beyond the chord at y columns are whole or empty; above it they end on the circle and on the chord.
  const double chord = std::sqrt(r * r - y * y), mid = std::clamp(x, -chord, chord);
  double sides = half_chords(std::min(x, -chord)) - half_chords(-r);
  if (x > chord) sides += half_chords(x) - half_chords(chord);
  return (y > 0 ? 2 * sides : 0) + half_chords(mid) - half_chords(-chord) + y * (mid + chord);
}

}  // namespace

double naive_coverage(const oracle::Edge& edge, Pixel pixel, double width) {
  const auto inside = [&](Vec2 p) {
    return (p.x - edge.through[0]) * edge.normal[0] + (p.y - edge.through[1]) * edge.normal[1];
  };
  return area(clipped(window(pixel, width), inside)) / (width * width);
}

double naive_coverage(const oracle::Disk& disk, Pixel pixel, double width) {
  const Corners w = window(pixel, width);
  const double left = w[0].x - disk.center[0], right = w[2].x - disk.center[0];
  const double top = w[0].y - disk.center[1], bottom = w[2].y - disk.center[1], r = disk.radius;
  const double part = quarter_plane(r, right, bottom) - quarter_plane(r, left, bottom) -
                      (quarter_plane(r, right, top) - quarter_plane(r, left, top));
  return part / (width * width);
}

double naive_coverage(const oracle::Board& board, Pixel pixel, double width) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN(), kMost = 4096;
  const std::array<double, 9>& h = board.homography;
  std::array<double, 4> e{HUGE_VAL, -HUGE_VAL, HUGE_VAL, -HUGE_VAL};
  const Corners w = window(pixel, width);
  for (const Vec2 p : w) {
    const double depth = h[6] * p.x + h[7] * p.y + h[8];
    if (!(depth > 0)) return kNone;
    const double u = (h[0] * p.x + h[1] * p.y + h[2]) / depth, v = (h[3] * p.x + h[4] * p.y + h[5]) / depth;
    e = {std::min(e[0], u), std::max(e[1], u), std::min(e[2], v), std::max(e[3], v)};
  }
  e = {std::max(e[0], board.extent[0]), std::min(e[1], board.extent[1]), std::max(e[2], board.extent[2]),
       std::min(e[3], board.extent[3])};
  if (!((e[1] - e[0] + 1) * (e[3] - e[2] + 1) < kMost) || !(std::fabs(e[0]) < 0x1p50) || !(std::fabs(e[2]) < 0x1p50))
    return kNone;
  const double g[9] = {h[4] * h[8] - h[5] * h[7], h[2] * h[7] - h[1] * h[8], h[1] * h[5] - h[2] * h[4],
                       h[5] * h[6] - h[3] * h[8], h[0] * h[8] - h[2] * h[6], h[2] * h[3] - h[0] * h[5],
                       h[3] * h[7] - h[4] * h[6], h[1] * h[6] - h[0] * h[7], h[0] * h[4] - h[1] * h[3]};
  double part = 0;
  for (double v = std::floor(e[2]); v < e[3]; v += 1)
    for (double u = std::floor(e[0]); u < e[1]; u += 1) {
      if (std::fmod(std::fabs(u + v), 2) == 1) continue;
      const double ul = std::max(u, board.extent[0]), ur = std::min(u + 1, board.extent[1]);
      const double vl = std::max(v, board.extent[2]), vr = std::min(v + 1, board.extent[3]);
      Corners square;
      for (const Vec2 q : {Vec2{ul, vl}, {ur, vl}, {ur, vr}, {ul, vr}}) {
        const double z = g[6] * q.x + g[7] * q.y + g[8];
        square.push_back({(g[0] * q.x + g[1] * q.y + g[2]) / z, (g[3] * q.x + g[4] * q.y + g[5]) / z});
      }
      square = clipped(square, [&](Vec2 p) { return p.x - w[0].x; });
      square = clipped(square, [&](Vec2 p) { return w[2].x - p.x; });
      square = clipped(square, [&](Vec2 p) { return p.y - w[0].y; });
      square = clipped(square, [&](Vec2 p) { return w[2].y - p.y; });
      part += area(square);
    }
  return part / (width * width);
}

}  // namespace moire::stress
