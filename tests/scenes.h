// Builds test images from numbers, as a scene file would: those of stress/scenes.h, and scenes of many disks.
#pragma once

#include <utility>
#include <vector>

#include "stress/scenes.h"

namespace moire::scenes {

// Disjoint disks, x, y, radius of each.
inline TestImage disks(std::vector<double> circles, Grid grid = {64, 64}) {
  return {find_testimage("disks", ""), {{"disks", rows(std::move(circles), 3)}}, grid, "test"};
}

// A noise field of the usual count and radii.
inline TestImage usual_noise_field(int seed = 1, Grid grid = {64, 64}) {
  return {find_testimage("noise-field", ""), {{"seed", one(seed)}}, grid, "test"};
}

// Random small disks; radii between the two.
inline TestImage noise_field(int count, double min_radius, double max_radius, int seed = 1, Grid grid = {64, 64}) {
  return {find_testimage("noise-field", ""),
          {{"count", one(count)}, {"radius", list({min_radius, max_radius})}, {"seed", one(seed)}},
          grid,
          "test"};
}

}  // namespace moire::scenes
