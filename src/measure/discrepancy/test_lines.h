// Random lines that hit the unit square, to test sets of points with; and the areas they cut off.
#pragma once

#include <cstdint>
#include <vector>

#include "core/hash.h"
#include "measure/discrepancy/line_law.h"

namespace moire {

// The line nx x + ny y = c; a point with nx x + ny y >= c is above it.
struct TestLine {
  double nx = 0, ny = 1, c = 0;
};

// Line `index` of the key; (nx, ny) is a unit vector but for rounding. Lines of one law and key are independent; the
// laws share their random numbers.
//
// Isotropic: n has density (|nx| + |ny|) / 8 over the angle, so either side of a line is as often above as the other; c
// is uniform between the square's lowest and highest corner.
//
// Printed: y = m x + b with m = (r1 - 1/2) / (r2 - 1/2) and b uniform over what hits the square; above is y > m x + b.
// The law of the slope is not the isotropic one, though the paper says so: the angle between a line and the nearer
// axis, within [0, 45] degrees, has density 1 / cos^2 and not sin + cos, which is 41% more lines at 45 degrees.
TestLine test_line(LineLaw law, const Key& key, std::uint64_t index) noexcept;

// Area of the part of the unit square above the line, in [0, 1]; (nx, ny) need not be a unit vector but is not zero.
// Relative error below 2^-50, however small the area; for products of nx, ny and c in the range of normal numbers.
double area_above(const TestLine& line) noexcept;

struct MeasuredLine {
  TestLine line;
  double area = 0;  // above it
};
// Lines 0 to count - 1 with their areas: for many sets of points, since to draw a line costs as much as to test it
// against hundreds of points.
std::vector<MeasuredLine> measured_lines(LineLaw law, const Key& key, std::int64_t count);

}  // namespace moire
