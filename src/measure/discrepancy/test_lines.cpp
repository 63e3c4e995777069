// Random lines through the unit square, and the areas above them.
#include "measure/discrepancy/test_lines.h"

#include <algorithm>
#include <cmath>

#include "core/double_double.h"

namespace moire {
namespace {

// Words of one index; `part` is 0 or 1.
Words words_of(const Key& key, std::uint64_t index, std::uint32_t part) noexcept {
  return hash(key, static_cast<std::uint32_t>(index), Axis::test_line,
              2 * static_cast<std::uint32_t>(index >> 32) + part);
}

// With theta in [0, 90] degrees of density (sin + cos) / 2, sin - cos is uniform in [-1, 1] and sin + cos follows from
// it: no trigonometry. The two mirror images come from bits that unit() leaves over.
TestLine isotropic_line(const Key& key, std::uint64_t index) noexcept {
  const Words r = words_of(key, index, 0);
  const double difference = 2 * unit(r.a, r.b) - 1, sum = std::sqrt(2 - difference * difference);
  const double nx = (sum - difference) / 2, ny = (sum + difference) / 2;  // both >= 0
  const bool left = (r.b & 1) != 0, down = (r.d & 1) != 0;
  const double lowest = -((left ? nx : 0) + (down ? ny : 0));
  return {left ? -nx : nx, down ? -ny : ny, lowest + unit(r.c, r.d) * (nx + ny)};
}

// With m = rise / run and run > 0, y > m x + b is run y - rise x > run b. That has no pole where the paper's m has one;
// where both are 0 (chance 2^-104), the line is level.
TestLine printed_line(const Key& key, std::uint64_t index) noexcept {
  const Words r = words_of(key, index, 0), s = words_of(key, index, 1);
  double rise = unit(r.a, r.b) - 0.5, run = unit(r.c, r.d) - 0.5;
  if (run < 0) {
    run = -run;
    rise = -rise;
  }
  const double u = unit(s.a, s.b), length = std::hypot(rise, run);
  if (length == 0) return {0, 1, u};
  // run times b = (1 - m) u where m < 0, and (-1 - m) u + 1 elsewhere.
  const double scaled_b = rise < 0 ? (run - rise) * u : run - (run + rise) * u;
  return {-rise / length, run / length, scaled_b / length};
}

// a + b - c, rounded once but for 2^-100 of itself.
double sum_less(double a, double b, double c) noexcept {
  const Dd s = two_sum(a, b), d = two_sum(s.hi, -c);
  return d.hi + (d.lo + s.lo);
}

}  // namespace

TestLine test_line(LineLaw law, const Key& key, std::uint64_t index) noexcept {
  return law == LineLaw::isotropic ? isotropic_line(key, index) : printed_line(key, index);
}

// Mirrored and transposed until n has 0 <= small <= large: heights n.p - c of the square's corners are then, from the
// lowest to the highest, h, h + small, h + large, h + small + large. All that is added below has one sign, and each
// height is rounded from its exact value.
double area_above(const TestLine& line) noexcept {
  const double small = std::min(std::fabs(line.nx), std::fabs(line.ny)),
               large = std::max(std::fabs(line.nx), std::fabs(line.ny));
  // x_low is what x adds to the height at the side of the square where that is least, x_high where it is most.
  const double x_low = std::min(line.nx, 0.0), x_high = std::max(line.nx, 0.0), y_low = std::min(line.ny, 0.0),
               y_high = std::max(line.ny, 0.0);
  const bool x_is_small = std::fabs(line.nx) <= std::fabs(line.ny);
  const double lowest = sum_less(x_low, y_low, line.c), highest = sum_less(x_high, y_high, line.c);
  if (lowest >= 0) return 1;
  if (highest <= 0) return 0;
  // The corners beside the lowest and beside the highest, along the side with the smaller difference.
  const double second = x_is_small ? sum_less(x_high, y_low, line.c) : sum_less(x_low, y_high, line.c);
  const double third = x_is_small ? sum_less(x_low, y_high, line.c) : sum_less(x_high, y_low, line.c);
  if (third <= 0) return highest / small * (highest / large) / 2;     // one corner above: a triangle
  if (second >= 0) return 1 - lowest / small * (lowest / large) / 2;  // one corner below
  return (highest + third) / (2 * large);                             // two and two: a trapezium
}

std::vector<MeasuredLine> measured_lines(LineLaw law, const Key& key, std::int64_t count) {
  std::vector<MeasuredLine> lines(static_cast<std::size_t>(count));
  for (std::size_t i = 0; i < lines.size(); ++i) {
    lines[i].line = test_line(law, key, i);
    lines[i].area = area_above(lines[i].line);
  }
  return lines;
}

}  // namespace moire
