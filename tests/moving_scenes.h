// Builds test images that move while the shutter is open, as a scene file would; and what they are at a time.
#pragma once

#include <vector>

#include "scenes.h"

namespace moire::scenes {

// A scene with a motion, also one of (0, 0).
inline Given with_motion(Given keys, Vec2 motion) {
  keys.emplace_back("motion", list({motion.x, motion.y}));
  return keys;
}

inline TestImage moving_edge(Vec2 through, Vec2 normal, Vec2 motion, Grid grid = {64, 64}) {
  return {find_testimage("edge", ""),
          with_motion({{"through", list({through.x, through.y})}, {"normal", list({normal.x, normal.y})}}, motion),
          grid, "test"};
}

inline TestImage moving_disk(Vec2 center, double radius, Vec2 motion, Grid grid = {64, 64}) {
  return {find_testimage("disk", ""),
          with_motion({{"center", list({center.x, center.y})}, {"radius", one(radius)}}, motion), grid, "test"};
}

inline TestImage moving_disks(std::vector<double> circles, Vec2 motion, Grid grid = {64, 64}) {
  return {find_testimage("disks", ""), with_motion({{"disks", rows(std::move(circles), 3)}}, motion), grid, "test"};
}

}  // namespace moire::scenes
