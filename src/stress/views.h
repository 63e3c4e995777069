// Places of a board's image by how far below its horizon they are.
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "stress/scenes.h"

namespace moire::scenes {

// The point of the plane seen at p, and W there (positive where the plane is seen).
struct Seen {
  double u, v, w;
};
inline Seen look(const std::vector<double>& h, Vec2 p) {
  const double w = h[6] * p.x + h[7] * p.y + h[8];
  return {(h[0] * p.x + h[1] * p.y + h[2]) / w, (h[3] * p.x + h[4] * p.y + h[5]) / w, w};
}

// A homography, pixels to plane, and a place of its image.
struct View {
  std::vector<double> homography;
  Vec2 at;
  Pixel pixel() const {
    return {static_cast<std::int64_t>(std::floor(at.x)), static_cast<std::int64_t>(std::floor(at.y))};
  }
};

// The place so many rows of pixels below the horizon, and so many focal lengths along it from the point nearest to the
// principal one. A camera that looks straight down has no horizon.
inline View view_of(const Camera& camera, double rows, double along) {
  View view{homography_of(camera), {}};
  const std::vector<double>& h = view.homography;
  const double size = std::hypot(h[6], h[7]), nx = h[6] / size, ny = h[7] / size;
  const double down = rows - (h[6] * camera.principal.x + h[7] * camera.principal.y + h[8]) / size;
  along *= camera.focal;
  view.at = {camera.principal.x + down * nx - along * ny, camera.principal.y + down * ny + along * nx};
  return view;
}

}  // namespace moire::scenes
