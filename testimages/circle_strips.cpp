// What strips of a pixel hold of a disk; see HasStrips (testimage.h). A file of its own because it is compiled without
// errno for square roots, which are then taken several at a time.
#include <algorithm>
#include <cmath>

#include "testimages/circle.h"

namespace moire {
namespace {

// A circle whose centre is more pixels away than this in x has only one side in a pixel.
constexpr double kNearColumns = 1024;

}  // namespace

// On a line of constant y the circle is at x = cx -+ w with w^2 = D = cx^2 - q and q = y (y - 2 cy) - power. D is
// concave in y: over a strip it is least on a side, and greatest where y is nearest to the centre's.
//
// Roundings, with d = doubt(1, 1), which is 8 u of 1 + 2 |cx| + 1 + 2 |cy| + |power|: q errs by less than d / 2, D by
// less than d + 8 u cx^2, the centre's rounding among them.
void strips(const GivenCircle& circle, Pixel origin, std::span<const double> sides, Strips out) noexcept {
  const LocalCircle at = seen_from(circle, origin, 0);
  const double cx = at.cx.hi, cy = at.cy.hi, power = at.power, doubt = at.doubt(1, 1), cx2 = cx * cx;
  const double error = doubt + 8 * 0x1p-53 * cx2;
  const auto q = [=](double y) { return y * (y - 2 * cy) - power; };
  const std::size_t count = sides.size() - 1;
  const double* __restrict side = sides.data();
  if (std::fabs(cx) <= kNearColumns) {
    // cx and w are below 2^11 where the root is in the pixel, so that their roundings stay below 2^-40.
    constexpr double kMargin = 0x1p-38;
    double *__restrict outer_begin = out.outer_begin.data(), *__restrict outer_end = out.outer_end.data(),
                       *__restrict inner_begin = out.inner_begin.data(), *__restrict inner_end = out.inner_end.data();
    // In three loops, so that each vectorises: D, w, x. Where no D is positive there is nothing.
    for (std::size_t j = 0; j < count; ++j) {
      const double a = side[j], b = side[j + 1];
      const double most = cx2 - q(std::min(std::max(cy, a), b)) + error, least = cx2 - std::max(q(a), q(b)) - error;
      outer_begin[j] = most < 0 ? HUGE_VAL : 0.0;
      outer_end[j] = std::max(most, 0.0);
      inner_end[j] = std::max(least, 0.0);
    }
    for (std::size_t j = 0; j < count; ++j) {
      outer_end[j] = std::sqrt(outer_end[j]) + kMargin;
      inner_end[j] = std::sqrt(inner_end[j]) - kMargin;
    }
    for (std::size_t j = 0; j < count; ++j) {
      const double outer = outer_end[j], inner = inner_end[j];
      outer_begin[j] += cx - outer;
      outer_end[j] = cx + outer;
      inner_begin[j] = cx - inner;
      inner_end[j] = cx + inner;
    }
    return;
  }
  // Far to one side: only the root on the pixel's side counts, and to subtract would lose it. It is q / (cx + w), or
  // with everything mirrored -q / (|cx| + w). Where |x| <= 1, q is within 2^-9 of cx^2 of zero: the denominator is then
  // right to 4 u and d / cx^2, and x to 6 u and 2 d / |cx|. With no root w is 0, and x beyond the pixel as it must be.
  const double far = std::fabs(cx), margin = 0x1p-45 + 2 * doubt / far, sign = cx > 0 ? 1 : -1;
  double* __restrict outer = (cx > 0 ? out.outer_begin : out.outer_end).data();
  double* __restrict inner = (cx > 0 ? out.inner_begin : out.inner_end).data();
  for (std::size_t j = 0; j < count; ++j) {
    const double a = side[j], b = side[j + 1];
    const double least = q(std::min(std::max(cy, a), b)), most = std::max(q(a), q(b));
    outer[j] = sign * (least / (far + std::sqrt(std::max(cx2 - least, 0.0))) - margin);
    inner[j] = sign * (most / (far + std::sqrt(std::max(cx2 - most, 0.0))) + margin);
  }
  const double open = sign * HUGE_VAL;
  for (const std::span<double> other :
       {cx > 0 ? out.outer_end : out.outer_begin, cx > 0 ? out.inner_end : out.inner_begin})
    std::fill_n(other.begin(), count, open);
}

}  // namespace moire
