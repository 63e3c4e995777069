// Stored doubles to 113-bit geometry around a pixel; see scene.h.
#include "oracle/scene.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

namespace moire::oracle {
namespace {

std::vector<double> stored(const TestImage& image, std::string_view name) {
  for (const auto& [key, numbers] : image.stored())
    if (key == name) return numbers;
  throw std::out_of_range("not stored: " + std::string(name));
}

// A point of the image as (X, Y, Z), x = X/Z, y = Y/Z.
struct Homogeneous {
  Quad x, y, z;
};

// One step of Sutherland and Hodgman: keeps the part where a x + b y + c z >= 0.
void clip_plane(std::vector<Homogeneous>& polygon, std::vector<Homogeneous>& scratch, Quad a, Quad b, Quad c) {
  scratch.clear();
  const std::size_t n = polygon.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Homogeneous &p = polygon[i], &q = polygon[(i + 1) % n];
    const Quad at_p = a * p.x + b * p.y + c * p.z, at_q = a * q.x + b * q.y + c * q.z;
    if (at_p >= 0) scratch.push_back(p);
    if ((at_p >= 0) != (at_q >= 0)) {
      const Quad t = at_p / (at_p - at_q);
      scratch.push_back({p.x + t * (q.x - p.x), p.y + t * (q.y - p.y), p.z + t * (q.z - p.z)});
    }
  }
  polygon.swap(scratch);
}

// The rows U, V, W as functions of a point relative to the pixel's centre.
std::array<Quad, 9> around(const Board& board, Pixel pixel) {
  std::array<Quad, 9> h;
  for (std::size_t i = 0; i < 9; ++i) h[i] = widen(board.homography[i]);
  const Quad cx = static_cast<Quad>(pixel.x) + Quad(1) / 2, cy = static_cast<Quad>(pixel.y) + Quad(1) / 2;
  for (std::size_t row = 0; row < 3; ++row) h[3 * row + 2] += h[3 * row] * cx + h[3 * row + 1] * cy;
  return h;
}

// A point's place on the plane.
Point project(const std::array<Quad, 9>& h, const Point& p) {
  const Quad w = h[6] * p.x + h[7] * p.y + h[8];
  return {(h[0] * p.x + h[1] * p.y + h[2]) / w, (h[3] * p.x + h[4] * p.y + h[5]) / w};
}

// An extent of whole squares that holds all of a board without end that is seen in `front`, one square to spare.
std::array<double, 4> extent_around(const std::array<Quad, 9>& h, const Polygon& front) {
  std::array<double, 4> e{HUGE_VAL, -HUGE_VAL, HUGE_VAL, -HUGE_VAL};
  for (const Point& p : front) {
    const Point q = project(h, p);
    e[0] = std::min(e[0], std::floor(static_cast<double>(q.x)) - 1);
    e[1] = std::max(e[1], std::floor(static_cast<double>(q.x)) + 2);
    e[2] = std::min(e[2], std::floor(static_cast<double>(q.y)) - 1);
    e[3] = std::max(e[3], std::floor(static_cast<double>(q.y)) + 2);
  }
  return e;
}

}  // namespace

Edge edge_of(const TestImage& image) {
  const auto t = stored(image, "through"), n = stored(image, "normal");
  return {{t.at(0), t.at(1)}, {n.at(0), n.at(1)}};
}

Disk disk_of(const TestImage& image) {
  const auto c = stored(image, "center"), r = stored(image, "radius");
  return {{c.at(0), c.at(1)}, r.at(0)};
}

Board board_of(const TestImage& image) {
  Board b{};
  const auto h = stored(image, "homography");
  for (std::size_t i = 0; i < 9; ++i) b.homography[i] = h.at(i);
  b.extent = {-HUGE_VAL, HUGE_VAL, -HUGE_VAL, HUGE_VAL};
  if (image.stored().size() == 1) return b;
  const auto e = stored(image, "extent");
  for (std::size_t i = 0; i < 4; ++i) b.extent[i] = e.at(i);
  return b;
}

HalfPlane around(const Edge& edge, Pixel pixel) {
  const Quad nx = widen(edge.normal[0]), ny = widen(edge.normal[1]);
  return {nx, ny, -(relative(edge.through[0], pixel.x) * nx + relative(edge.through[1], pixel.y) * ny)};
}

Circle around(const Disk& disk, Pixel pixel) {
  return {{relative(disk.center[0], pixel.x), relative(disk.center[1], pixel.y)}, widen(disk.radius)};
}

Polygon clip(const HalfPlane& h, Quad half) {
  std::vector<Homogeneous> polygon{{-half, -half, 1}, {half, -half, 1}, {half, half, 1}, {-half, half, 1}}, scratch;
  clip_plane(polygon, scratch, h.nx, h.ny, h.offset);
  Polygon out;
  for (const Homogeneous& p : polygon) out.push_back({p.x / p.z, p.y / p.z});
  return out;
}

Polygon clip_front(const Board& board, Pixel pixel, Quad half, Quad nearest) {
  const std::array<Quad, 9> h = around(board, pixel);
  std::vector<Homogeneous> polygon{{-half, -half, 1}, {half, -half, 1}, {half, half, 1}, {-half, half, 1}}, scratch;
  clip_plane(polygon, scratch, h[6], h[7], h[8] - nearest);
  Polygon out;
  for (const Homogeneous& p : polygon) out.push_back({p.x / p.z, p.y / p.z});
  return out;
}

Quad squares_in(const Board& board, Pixel pixel, const Polygon& polygon) {
  const std::array<Quad, 9> h = around(board, pixel);
  Polygon seen;
  for (const Point& p : polygon) seen.push_back(project(h, p));
  Quad perimeter = 0;
  for (std::size_t i = 0; i < seen.size(); ++i) {
    const Point &p = seen[i], &q = seen[(i + 1) % seen.size()];
    perimeter += abs(q.x - p.x) + abs(q.y - p.y);
  }
  return area(seen) + perimeter / 2;
}

std::vector<Polygon> clip(const Board& board, Pixel pixel, Quad half, Quad nearest) {
  const std::array<Quad, 9> h = around(board, pixel);
  // The adjugate maps (u, v, 1) back to a multiple of (x, y, 1); with the determinant's sign the factor has that of W.
  std::array<Quad, 9> g{h[4] * h[8] - h[5] * h[7], h[2] * h[7] - h[1] * h[8], h[1] * h[5] - h[2] * h[4],
                        h[5] * h[6] - h[3] * h[8], h[0] * h[8] - h[2] * h[6], h[2] * h[3] - h[0] * h[5],
                        h[3] * h[7] - h[4] * h[6], h[1] * h[6] - h[0] * h[7], h[0] * h[4] - h[1] * h[3]};
  if (h[0] * g[0] + h[1] * g[3] + h[2] * g[6] < 0)
    for (Quad& v : g) v = -v;

  std::vector<Homogeneous> polygon, scratch;
  const bool endless = !std::isfinite(board.extent[0]);
  // The window's part of a rectangle of the plane, left in `polygon`; empty when they do not meet.
  const auto clip_rectangle = [&](double ul, double ur, double vl, double vr) {
    polygon.clear();
    for (const auto& [u, v] : {std::pair{ul, vl}, {ur, vl}, {ur, vr}, {ul, vr}}) {
      const Quad p = widen(u), q = widen(v);
      polygon.push_back({g[0] * p + g[1] * q + g[2], g[3] * p + g[4] * q + g[5], g[6] * p + g[7] * q + g[8]});
    }
    // Opposite sides together say Z >= 0: what is behind the camera goes with them.
    const Quad side[4][3] = {{1, 0, half}, {-1, 0, half}, {0, 1, half}, {0, -1, half}};
    for (const auto& s : side)
      if (!polygon.empty()) clip_plane(polygon, scratch, s[0], s[1], s[2]);
    if (endless && !polygon.empty()) clip_plane(polygon, scratch, h[6], h[7], h[8] - nearest);
    return polygon.size() >= 3;
  };

  std::vector<Polygon> out;
  const Polygon front = endless ? clip_front(board, pixel, half, nearest) : Polygon{};
  if (endless && front.size() < 3) return out;
  const auto [u0, u1, v0, v1] = endless ? extent_around(h, front) : board.extent;
  for (double v = std::floor(v0); v < v1; v += 1) {
    const double vl = std::max(v, v0), vr = std::min(v + 1, v1);
    if (!clip_rectangle(u0, u1, vl, vr)) continue;
    // Only the squares between the row's leftmost and rightmost seen points, and one more on each side.
    double left = u1, right = u0;
    for (const Homogeneous& p : polygon) {
      const Quad u = (h[0] * p.x + h[1] * p.y + h[2] * p.z) / (h[6] * p.x + h[7] * p.y + h[8] * p.z);
      left = std::min(left, static_cast<double>(u));
      right = std::max(right, static_cast<double>(u));
    }
    for (double u = std::max(std::floor(u0), std::floor(left) - 1); u < std::min(u1, right + 1); u += 1) {
      if (std::fmod(std::fabs(u + v), 2) == 1) continue;
      if (!clip_rectangle(std::max(u, u0), std::min(u + 1, u1), vl, vr)) continue;
      Polygon p;
      for (const Homogeneous& q : polygon) p.push_back({q.x / q.z, q.y / q.z});
      out.push_back(std::move(p));
    }
  }
  return out;
}

Quad area(const Polygon& p) {
  Quad twice = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const Point &a = p[i], &b = p[(i + 1) % p.size()];
    twice += a.x * b.y - a.y * b.x;
  }
  return abs(twice) / 2;
}

}  // namespace moire::oracle
