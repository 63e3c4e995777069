// Drawings of sets of points, and of lines through the unit square beside their duals.
#pragma once

#include <span>
#include <string>
#include <utility>
#include <vector>

#include "reports/images.h"

namespace moire {

// Points of the unit square, y down, as dots on white; with a time, the dots run from blue (0) over grey to red (1).
// x, y (and t) in [0, 1), as many of each.
Raster point_plot(std::span<const double> x, std::span<const double> y, std::span<const double> t = {});

// The line n.p = c.
struct PlotLine {
  double nx = 0, ny = 1, c = 0;
};

// Left: the lines across the unit square, here with y up. Right: each line y = m x + b as the point (m, b), both from
// -4 to 5; others are beyond the frame. Text chunk moire:beyond: how many those are.
Raster line_plot(std::span<const PlotLine> lines);

}  // namespace moire
