// A row of the homography is known by its value in the rectangle's middle and by how far it goes from there; a board
// line U - k W is a difference of two.
//
// u = 2^-53. With T the sum of |a x|, |b y| and |c| at the largest |x| and |y| that coordinates are made of, the middle
// is right to 3 u of those, a value there to 7 u T and the spread to 4 u T; those of a line to the sum of both rows',
// W's times |k|, and 4 u of that. 32 u T is more than twice all: where this is sure, Checkerboard::cover() would be,
// too.
#include "testimages/board_cover.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "core/rounding.h"

namespace moire {
namespace {

// Middle and half sides of a rectangle in the image, and the largest coordinates on the way to them.
struct Place {
  double x, y, half_x, half_y, largest_x, largest_y;
};

// A linear function over a rectangle: value in the middle, largest difference from it, and the doubt in their sum.
struct Values {
  double a, b, middle, spread, doubt;
  bool above() const { return middle - spread > doubt; }
  bool below() const { return middle + spread < -doubt; }
  // Takes both signs.
  bool crosses() const { return std::fabs(middle) < spread - doubt; }
};

Values row_values(const double* row, const Place& p) {
  const double a = std::fabs(row[0]), b = std::fabs(row[1]);
  return {row[0], row[1], row[0] * p.x + row[1] * p.y + row[2], a * p.half_x + b * p.half_y,
          32 * kUnit * (a * p.largest_x + b * p.largest_y + std::fabs(row[2]))};
}

Values line_values(const Values& r, const Values& w, double k, const Place& p) {
  const double a = r.a - k * w.a, b = r.b - k * w.b;
  return {a, b, r.middle - k * w.middle, std::fabs(a) * p.half_x + std::fabs(b) * p.half_y,
          r.doubt + std::fabs(k) * w.doubt};
}

// floor of |x| < 2^50, without the call that baseline x86-64 makes of it.
double floor_of(double x) {
  const auto towards_zero = static_cast<double>(static_cast<std::int64_t>(x));
  return towards_zero > x ? towards_zero - 1 : towards_zero;
}

}  // namespace

std::optional<Cover> quick_cover(const Matrix3& h, const Extent& extent, Pixel origin, Rect r) noexcept {
  constexpr std::int64_t kFarthest = std::int64_t{1} << 50;
  if (origin.x > kFarthest || origin.x < -kFarthest || origin.y > kFarthest || origin.y < -kFarthest) {
    return std::nullopt;
  }
  const auto ox = static_cast<double>(origin.x), oy = static_cast<double>(origin.y);
  const Place p{ox + 0.5 * (r.lo.x + r.hi.x),
                oy + 0.5 * (r.lo.y + r.hi.y),
                0.5 * (r.hi.x - r.lo.x),
                0.5 * (r.hi.y - r.lo.y),
                std::fabs(ox) + std::max(std::fabs(r.lo.x), std::fabs(r.hi.x)),
                std::fabs(oy) + std::max(std::fabs(r.lo.y), std::fabs(r.hi.y))};
  const Values w = row_values(&h[6], p);
  if (w.below()) return Cover::none;
  if (!w.above()) return std::nullopt;

  const double per_w = 1 / w.middle, sides[2][2] = {{extent.u0, extent.u1}, {extent.v0, extent.v1}};
  const Values rows[2] = {row_values(&h[0], p), row_values(&h[3], p)};
  double square[2];
  bool whole[2];  // the square is on the board, which it can be in part only where the rim is no whole number
  for (std::size_t f = 0; f < 2; ++f) {
    const auto [low, high] = sides[f];
    const double q = rows[f].middle * per_w;
    if (!(std::fabs(q) < 0x1p40)) return std::nullopt;
    // Where the middle is on the board, the rectangle is not clear of it.
    if (q < low && line_values(rows[f], w, low, p).below()) return Cover::none;
    if (q > high && line_values(rows[f], w, high, p).above()) return Cover::none;
    square[f] = floor_of(q);
    whole[f] = square[f] >= low && square[f] + 1 <= high;
  }
  // Off the board by the middle, but not as a whole, it meets the rim, or comes within doubt of it.
  for (std::size_t f = 0; f < 2; ++f) {
    const Values here = line_values(rows[f], w, square[f], p), next = line_values(rows[f], w, square[f] + 1, p);
    if (whole[0] && whole[1] && (here.crosses() || next.crosses())) return Cover::partial;
    if (!whole[0] || !whole[1] || !here.above() || !next.below()) return std::nullopt;
  }
  return even_square(square[0], square[1]) ? Cover::all : Cover::none;
}

}  // namespace moire
