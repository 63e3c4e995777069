// A power law through measurements, such as cost against sample count: y = c n^p by least squares of the logarithms.
#pragma once

#include <optional>
#include <span>

#include "measure/statistics.h"

namespace moire {

// One measurement; only those with n > 0 and y > 0, both finite, are used.
struct PowerPoint {
  double n = 0, y = 0;
};

struct PowerLaw {
  double exponent = 0, factor = 0;   // p and c
  std::optional<Interval> interval;  // of the exponent
  double n_min = 0, n_max = 0;       // of the points used
  int points = 0;
};

// Fewer than 2 different n: none. The interval is Student's for the slope of a line, from the points' distances to it
// (N. R. Draper, H. Smith, "Applied regression analysis", 1998, section 1.4): it needs 3 points, and speaks of points
// that scatter around a power law. A sum of powers, such as a fixed cost plus one per sample, bends; then the exponent
// is that of this range of n, and the interval says how far from a line the points are.
std::optional<PowerLaw> fit_power_law(std::span<const PowerPoint> points);

}  // namespace moire
