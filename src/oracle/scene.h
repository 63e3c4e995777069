// Scenes as the oracle sees them: the stored doubles, and their geometry relative to a pixel's centre in 113 bits.
#pragma once

#include <array>
#include <vector>

#include "core/geometry.h"
#include "oracle/quad.h"
#include "testimages/testimage.h"

namespace moire::oracle {

// Inside: (p - through) . normal >= 0.
struct Edge {
  double through[2], normal[2];
};

// Inside: |p - center| <= radius.
struct Disk {
  double center[2], radius;
};

// (x, y, 1) -> (U, V, W), seen where W > 0; inside: u0 <= u < u1, v0 <= v < v1 and floor(u) + floor(v) even. The whole
// plane has an infinite extent.
struct Board {
  std::array<double, 9> homography;
  std::array<double, 4> extent;
};

// From a test image's stored doubles. Throws std::out_of_range for a name that is not stored.
Edge edge_of(const TestImage& image);
Disk disk_of(const TestImage& image);
Board board_of(const TestImage& image);

// p . n + offset >= 0 with p relative to the pixel's centre.
struct HalfPlane {
  Quad nx, ny, offset;
};
HalfPlane around(const Edge& edge, Pixel pixel);

struct Circle {
  Point center;
  Quad radius;
};
Circle around(const Disk& disk, Pixel pixel);

using Polygon = std::vector<Point>;

// The parts of a convex figure inside the square [-half, half]^2 around the pixel's centre, by Sutherland and Hodgman,
// "Reentrant polygon clipping", CACM 17(1), 1974. The board's squares are clipped in homogeneous coordinates, so that
// squares that pass under the camera need no case of their own. A board without end is clipped where W >= nearest only;
// its squares must be finite in number there, so that nearest > 0 where the window meets the horizon.
Polygon clip(const HalfPlane& half_plane, Quad half);
std::vector<Polygon> clip(const Board& board, Pixel pixel, Quad half, Quad nearest = 0);

// The part of the window where W >= nearest.
Polygon clip_front(const Board& board, Pixel pixel, Quad half, Quad nearest);
// About how many squares a polygon of that kind meets, W > 0 at its vertices: its area in the plane and half its
// perimeter there.
Quad squares_in(const Board& board, Pixel pixel, const Polygon& polygon);

// Unsigned, in pixel-local coordinates.
Quad area(const Polygon& polygon);

}  // namespace moire::oracle
