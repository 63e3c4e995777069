// Builds test images that move while the shutter is open, as a scene file would: those of stress/scenes.h, and disks.
#pragma once

#include <utility>
#include <vector>

#include "scenes.h"

namespace moire::scenes {

inline TestImage moving_disks(std::vector<double> circles, Vec2 motion, Grid grid = {64, 64}) {
  return {find_testimage("disks", ""), with_motion({{"disks", rows(std::move(circles), 3)}}, motion), grid, "test"};
}

}  // namespace moire::scenes
