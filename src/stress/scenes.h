// Builds test images from numbers, as a scene file would. Keys that are wrong throw Error as they do there.
#pragma once

#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "testimages/testimage.h"

namespace moire::scenes {

inline Value one(double a) {
  return {.text = {}, .numbers = {a}, .rank = 0, .columns = 0, .is_text = false, .place = {}};
}
inline Value list(std::vector<double> v) {
  return {.text = {}, .numbers = std::move(v), .rank = 1, .columns = 0, .is_text = false, .place = {}};
}
inline Value rows(std::vector<double> v, std::size_t columns) {
  return {.text = {}, .numbers = std::move(v), .rank = 2, .columns = columns, .is_text = false, .place = {}};
}

// The half-plane (p - through) . normal >= 0; the normal is taken as it is.
inline TestImage edge(Vec2 through, Vec2 normal, Grid grid = {64, 64}) {
  return {find_testimage("edge", ""),
          {{"through", list({through.x, through.y})}, {"normal", list({normal.x, normal.y})}},
          grid,
          "a scene"};
}

// The same with the normal in degrees from +x towards +y.
inline TestImage edge(Vec2 through, double degrees, Grid grid = {64, 64}) {
  return {find_testimage("edge", ""),
          {{"through", list({through.x, through.y})}, {"normal", one(degrees)}},
          grid,
          "a scene"};
}

inline TestImage disk(Vec2 center, double radius, Grid grid = {64, 64}) {
  return {
      find_testimage("disk", ""), {{"center", list({center.x, center.y})}, {"radius", one(radius)}}, grid, "a scene"};
}

// A scene with a motion, also one of (0, 0).
inline Given with_motion(Given keys, Vec2 motion) {
  keys.emplace_back("motion", list({motion.x, motion.y}));
  return keys;
}

// What these are at time 0 moves by `motion` while the shutter is open, from time 0 to 1.
inline TestImage moving_edge(Vec2 through, Vec2 normal, Vec2 motion, Grid grid = {64, 64}) {
  return {find_testimage("edge", ""),
          with_motion({{"through", list({through.x, through.y})}, {"normal", list({normal.x, normal.y})}}, motion),
          grid, "a scene"};
}

inline TestImage moving_disk(Vec2 center, double radius, Vec2 motion, Grid grid = {64, 64}) {
  return {find_testimage("disk", ""),
          with_motion({{"center", list({center.x, center.y})}, {"radius", one(radius)}}, motion), grid, "a scene"};
}

// `homography` row-major, pixels to plane; `extent` u0, u1, v0, v1.
inline TestImage board(std::vector<double> homography, std::vector<double> extent, Grid grid = {64, 64}) {
  return {find_testimage("checkerboard", ""),
          {{"homography", rows(std::move(homography), 3)}, {"extent", list(std::move(extent))}},
          grid,
          "a scene"};
}

// A pinhole camera over the plane: pixels, squares, degrees, as the [camera] table of a scene file has them.
struct Camera {
  double focal = 512;
  Vec2 principal;
  double height = 1, pitch = 20, yaw = 0, roll = 0;
};

inline Given camera_keys(const Camera& c) {
  return {{"camera.focal", one(c.focal)},   {"camera.principal", list({c.principal.x, c.principal.y})},
          {"camera.height", one(c.height)}, {"camera.pitch", one(c.pitch)},
          {"camera.yaw", one(c.yaw)},       {"camera.roll", one(c.roll)}};
}

inline TestImage board(const Camera& c, std::vector<double> extent, Grid grid = {64, 64}) {
  Given keys = camera_keys(c);
  keys.emplace_back("extent", list(std::move(extent)));
  return {find_testimage("checkerboard", ""), keys, grid, "a scene"};
}

// The same cameras over the whole plane, to the horizon.
inline TestImage plane(const Camera& c, Grid grid = {64, 64}) {
  return {find_testimage("checkerboard", ""), camera_keys(c), grid, "a scene"};
}
inline TestImage plane(std::vector<double> homography, Grid grid = {64, 64}) {
  return {find_testimage("checkerboard", ""), {{"homography", rows(std::move(homography), 3)}}, grid, "a scene"};
}

// The camera's homography by the contract of scene files, in plain double arithmetic: row-major, pixels to plane.
inline std::vector<double> homography_of(const Camera& c) {
  const double to_radians = std::numbers::pi / 180;
  const double cr = std::cos(c.roll * to_radians), sr = std::sin(c.roll * to_radians);
  const double cp = std::cos(c.pitch * to_radians), sp = std::sin(c.pitch * to_radians);
  const double cw = std::cos(c.yaw * to_radians), sw = std::sin(c.yaw * to_radians);
  std::vector<double> h(9);
  for (std::size_t column = 0; column < 3; ++column) {
    // The ray is linear in (x, y, 1): turn what multiplies x, y and 1.
    const double x = column == 0 ? 1 / c.focal : column == 2 ? -c.principal.x / c.focal : 0;
    const double y = column == 1 ? 1 / c.focal : column == 2 ? -c.principal.y / c.focal : 0;
    const double z = column == 2 ? 1 : 0;
    const double rolled_x = x * cr - y * sr, rolled_y = x * sr + y * cr;
    const double down = rolled_y * cp + z * sp, forward = -rolled_y * sp + z * cp;
    h[column] = c.height * (rolled_x * cw + forward * sw);
    h[3 + column] = c.height * (-rolled_x * sw + forward * cw);
    h[6 + column] = down;
  }
  return h;
}

}  // namespace moire::scenes
