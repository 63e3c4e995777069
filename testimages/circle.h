// A circle seen from a pixel: which points are inside, whether it meets a rectangle, what it adds to a boundary,
// whether two overlap. What the scenes `disk` and `disks` share.
//
// Signs are exact for the stored doubles, coordinates other than 0 being at least kMinRadius in magnitude (then no
// product comes near underflow): floating point with a bound on its error first, exact expansions where that is unsure.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <string_view>

#include "core/args.h"
#include "core/double_double.h"
#include "core/geometry.h"
#include "curve/boundary.h"
#include "testimages/testimage.h"

namespace moire {

// The doubles that define a disk, in pixels. Inside: |p - center| <= radius.
struct GivenCircle {
  Vec2 center;
  double radius = 0;
};

// Squares of smaller radii come near the smallest normal number.
inline constexpr double kMinRadius = 1e-100;

// Throws Error at v's place unless the radius is from kMinRadius to kMaxCoordinate; `name` is what the message calls
// it.
void require_radius(const Value& v, std::string_view name, double radius);

// The circle seen from a point: p is inside when x (x - 2 cx) + y (y - 2 cy) <= power, all relative to that point.
// power = R^2 - |c|^2 comes from double-double, so that nothing cancels for large disks far away.
struct LocalCircle {
  Dd cx, cy;
  double power;

  double excess(double x, double y) const { return x * (x - 2 * cx.hi) + y * (y - 2 * cy.hi) - power; }
  // Bound on the rounding error of excess() for |x| <= ax, |y| <= ay: 3 u for each product (the centre's rounding among
  // them), 2 u for the sums, 2 u for the power. Where the power cancels, its own error is below 20 * 2^-106 R^2, less
  // than what reaches of at least 1 give (R <= 1e15); smaller ones count as 1.
  double doubt(double ax, double ay) const {
    const double px = std::max(ax, 1.0), py = std::max(ay, 1.0);
    return 8 * 0x1p-53 * (px * (px + 2 * std::fabs(cx.hi)) + py * (py + 2 * std::fabs(cy.hi)) + std::fabs(power));
  }
};

// Seen from the upper left corner of pixel `origin` (shift 0) or from its centre (shift 0.5), the circle moved by
// `moved`.
LocalCircle seen_from(const GivenCircle& circle, Pixel origin, double shift, Vec2 moved = {}) noexcept;

// Sets inside[i] = 1 where point i, relative to the corner of pixel `origin`, is in the disk, and leaves the others as
// they are. Precondition: |x[i]| <= reach.x and |y[i]| <= reach.y.
void mark_inside(const GivenCircle& circle, Pixel origin, std::span<const double> x, std::span<const double> y,
                 Vec2 reach, std::span<std::uint8_t> inside) noexcept;

// The same for the disk moved by t[i] * motion. Precondition: |x[i] - t[i] * motion.x| and |t[i] * motion.x| <= reach.x
// up to rounding, and so for y.
void mark_inside_at(const GivenCircle& circle, Vec2 motion, Pixel origin, std::span<const double> x,
                    std::span<const double> y, std::span<const double> t, Vec2 reach,
                    std::span<std::uint8_t> inside) noexcept;

// What the closed rectangle r, relative to the same point as `at`, holds of the disk: none and all are certain.
Cover cover(const LocalCircle& at, Rect r) noexcept;

// The same at all times of a motion; r relative to the corner (shift 0) or centre (0.5) of pixel `origin`.
Cover cover(const GivenCircle& circle, Vec2 motion, Pixel origin, double shift, Rect r) noexcept;

// What strips of pixel `origin` hold of the disk: see HasStrips (testimage.h).
void strips(const GivenCircle& circle, Pixel origin, std::span<const double> sides, Strips out) noexcept;

// The circle as a boundary holds it; `at` is seen from a pixel's centre.
Circle boundary_circle(const GivenCircle& circle, const LocalCircle& at) noexcept;

// Whether the disks share more than one point, by exact signs; disks that touch do not.
bool overlap(const GivenCircle& a, const GivenCircle& b) noexcept;

}  // namespace moire
