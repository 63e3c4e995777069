// A straight edge: the half-plane (p - through) . n >= 0. The simplest image with all frequencies across one direction.
#include <algorithm>
#include <cmath>
#include <optional>

#include "core/dd_math.h"
#include "core/expansion.h"
#include "core/rounding.h"
#include "curve/sharp_polygon.h"
#include "testimages/point_signs.h"
#include "testimages/scene_args.h"
#include "testimages/testimage.h"

namespace moire {
namespace {

constexpr Param kParams[] = {
    numbers("through", true, "", "a point of the edge, [x, y] in pixels"),
    numbers("normal", true, "", "towards the inside: degrees from +x towards +y, or a vector [nx, ny]"),
    motion_param()};

// A component times a power of two that makes the larger one less than 1. One that is 2^900 times smaller, or more,
// counts only where the other's product is 0, and then by its sign: it is kept from losing that to underflow, here and
// in its products with positions in a pixel, multiples of 2^-53.
double scaled(double component, int exponent) {
  constexpr double kLeast = 0x1p-900;
  const double size = std::ldexp(std::fabs(component), exponent);
  return component == 0 ? 0 : std::copysign(std::max(size, kLeast), component);
}

// The unit vector of a direction in degrees, each component right to an ulp: reduced exactly to an octant, then sine
// and cosine in double-double. Multiples of 90 give 0 and 1 exactly, odd multiples of 45 equal magnitudes.
Vec2 unit_vector(double degrees) {
  const double turn = std::fmod(std::fabs(degrees), 360.0);  // exact, as is the next one
  const double rest = std::fmod(turn, 90.0);
  const auto quarter = std::lround((turn - rest) / 90);
  const bool beyond = rest > 45;
  const double octant = beyond ? 90 - rest : rest;
  const CosSin cs = dd_cos_sin(Dd(octant) * kPi / Dd(180));
  double c = cs.cos.value(), s = octant == 45 ? c : cs.sin.value();
  if (beyond) std::swap(c, s);
  Vec2 v{c, s};
  for (long i = 0; i < quarter; ++i) v = {-v.y, v.x};
  if (degrees < 0) v.y = -v.y;
  return {v.x + 0.0, v.y + 0.0};  // no negative zeros
}

class Edge {
 public:
  Edge(const Args& args, Grid) : through_(point(args, "through")), motion_(moire::motion(args)) {
    const Value& v = *args.find("normal");
    if (v.rank == 0 && v.numbers.size() == 1) {
      normal_ = unit_vector(v.numbers[0]);
    } else if (v.rank == 1 && v.numbers.size() == 2) {
      normal_ = {v.numbers[0], v.numbers[1]};
    } else {
      throw Error(v.place, "\"normal\" must be degrees or a vector [nx, ny]");
    }
    const double size = std::max(std::fabs(normal_.x), std::fabs(normal_.y));
    if (size == 0) throw Error(v.place, "\"normal\" has length 0; any other length is fine");
    // Only the direction counts: scaled by a power of two, which is exact, so that no product overflows or vanishes.
    int exponent = 0;
    std::frexp(size, &exponent);
    n_ = {scaled(normal_.x, -exponent), scaled(normal_.y, -exponent)};
    travel_ = two_prod(n_.x, motion_.x) + two_prod(n_.y, motion_.y);
    travel_error_ = 0x1p-100 * std::fabs(travel_.hi);
  }

  void contains(std::span<const Pixel> run, std::span<const double> x, std::span<const double> y,
                std::span<std::uint8_t> inside) const noexcept {
    const std::size_t n = x.size() / run.size();
    const SignLoops& loops = sign_loops().back();
    for (std::size_t p = 0; p < run.size(); ++p) {
      const auto [c, far] = offset(run[p], 0);
      // Below 3 u (|nx| + |ny|) + 2 u |s| for the sum and u |c| for the rounded offset; |s| <= |nx| + |ny| + |c|.
      const double doubt = 8 * kUnit * (std::fabs(n_.x) + std::fabs(n_.y) + std::fabs(c)) + far;
      if (!loops.mark_above({n_, c, doubt}, x.subspan(p * n, n), y.subspan(p * n, n), &inside[p * n])) continue;
      for (std::size_t i = p * n; i < (p + 1) * n; ++i) {
        if (std::fabs(n_.x * x[i] + n_.y * y[i] - c) <= doubt) inside[i] = exact_sign(run[p], {x[i], y[i]}) >= 0;
      }
    }
  }

  void contains_at(std::span<const Pixel> run, std::span<const double> x, std::span<const double> y,
                   std::span<const double> t, std::span<std::uint8_t> inside) const noexcept {
    const std::size_t n = x.size() / run.size();
    const double travel = travel_.value();
    for (std::size_t p = 0; p < run.size(); ++p) {
      const auto [c, far] = offset(run[p], 0);
      // As above, and 3 u |travel| for its rounding, its product with t and one sum more.
      const double doubt = 8 * kUnit * (std::fabs(n_.x) + std::fabs(n_.y) + std::fabs(c) + std::fabs(travel)) + far;
      for (std::size_t i = p * n; i < (p + 1) * n; ++i) {
        const double s = n_.x * x[i] + n_.y * y[i] - c - t[i] * travel;
        inside[i] = std::fabs(s) > doubt ? s > 0 : exact_sign(run[p], {x[i], y[i]}, t[i]) >= 0;
      }
    }
  }

  // At all times: those between the first and the last are between them in the offset, too.
  Cover cover(Pixel origin, Rect r) const noexcept {
    const auto [c, far] = offset(origin, 0);
    const double travel = travel_.value(), first = std::min(c, c + travel), last = std::max(c, c + travel);
    const double low = n_.x * (n_.x > 0 ? r.lo.x : r.hi.x) + n_.y * (n_.y > 0 ? r.lo.y : r.hi.y) - last;
    const double high = n_.x * (n_.x > 0 ? r.hi.x : r.lo.x) + n_.y * (n_.y > 0 ? r.hi.y : r.lo.y) - first;
    const double doubt =
        8 * kUnit *
            (std::fabs(n_.x) * std::max(std::fabs(r.lo.x), std::fabs(r.hi.x)) +
             std::fabs(n_.y) * std::max(std::fabs(r.lo.y), std::fabs(r.hi.y)) + std::fabs(c) + std::fabs(travel)) +
        far;
    if (low > doubt) return Cover::all;
    if (high < -doubt) return Cover::none;
    return Cover::partial;
  }

  // Along a line of constant y the edge is at x = (c - ny y) / nx; over a strip it is between where it is on its sides.
  bool strips(Pixel origin, std::span<const double> sides, Strips out) const noexcept {
    const auto [c, far] = offset(origin, 0);
    // As in contains(), twice: half of it is above the roundings here, which are below u (|ny| + 2 |c|) + far before
    // and 3 u |x| after the product with 1 / nx. A normal next to upright leans by 2^-1000, which is nothing beside
    // that.
    const double doubt = 2 * (8 * kUnit * (std::fabs(n_.x) + std::fabs(n_.y) + std::fabs(c)) + far);
    const double lean = std::copysign(std::max(std::fabs(n_.x), 0x1p-1000), n_.x), inverse = 1 / lean;
    const double margin = doubt * std::fabs(inverse), ny = n_.y;
    const bool to_the_right = lean > 0;
    const std::size_t count = sides.size() - 1;
    double* __restrict outer = to_the_right ? out.outer_begin.data() : out.outer_end.data();
    double* __restrict inner = to_the_right ? out.inner_begin.data() : out.inner_end.data();
    const double* __restrict side = sides.data();
    const double out_margin = to_the_right ? -margin : margin;
    for (std::size_t j = 0; j < count; ++j) {
      const double a = (c - ny * side[j]) * inverse, b = (c - ny * side[j + 1]) * inverse;
      const double left = std::min(a, b), right = std::max(a, b);
      outer[j] = (to_the_right ? left : right) + out_margin;
      inner[j] = (to_the_right ? right : left) - out_margin;
    }
    const std::span<double> outer_open = to_the_right ? out.outer_end : out.outer_begin;
    const std::span<double> inner_open = to_the_right ? out.inner_end : out.inner_begin;
    const double open = to_the_right ? HUGE_VAL : -HUGE_VAL;
    std::fill_n(outer_open.begin(), count, open);
    std::fill_n(inner_open.begin(), count, open);
    return true;
  }

  void boundary(Pixel origin, double half_width, Boundary& out) const {
    const Offset c = exact_offset(origin, 0.5);
    const Vec2 swept = sweep();
    // Wide enough that the window's sides, moved along, stay outside.
    const double reach = std::max(std::fabs(swept.x), std::fabs(swept.y));
    SharpClipper clipper(reach > 0 ? (half_width + reach) * (1 + 0x1p-40) : half_width);
    SharpPolygon inside;
    clipper.set_line(SharpClipper::kWindow, {n_.x, n_.y, -c.value, c.error});
    clipper.split(clipper.window(), SharpClipper::kWindow, &inside, nullptr);
    SharpClipper::append(inside, 1, out);
    out.area_error += clipper.area_error();
  }

  // The corner of the window on the side of the edge where its centre is not: a triangle, or, beyond the nearer one of
  // two more corners, a trapezoid. None for an edge that sweeps.
  std::optional<BoxIntegral> box_integral(Pixel origin, double half_width) const noexcept {
    if (travel_.hi != 0) return std::nullopt;
    const auto [c, far] = offset(origin, 0.5);
    const double h = half_width, size = std::fabs(c);
    const double p = std::max(std::fabs(n_.x), std::fabs(n_.y)), q = std::min(std::fabs(n_.x), std::fabs(n_.y));
    // How far the edge is inside the farthest corner, in values of n . x: four roundings of at most (p + q) h <= 2 p h.
    const double deep = p * h + q * h - size, doubt = 8 * kUnit * p * h + far;
    // Each with its three roundings, those of the trapezoid at most h before the last product.
    double corner = 0, rounding = 0;
    if (deep > 2 * q * h) {
      corner = 2 * h * (h - size / p);
      rounding = 6 * h * h;
    } else if (deep > 0) {
      corner = 0.5 * (deep / p) * (deep / q);
      rounding = 3 * corner;
    }
    if (c <= 0) rounding += 8 * h * h;  // taken from the window, which is itself rounded
    // The corner grows by the edge's extent along the axis of the lesser component, at most 2 h, over the greater one.
    const double reach = q > 0 ? std::min((std::max(deep, 0.0) + doubt) / q, 2 * h) : 2 * h;
    const double bound = (doubt * reach / p + rounding * kUnit) * (1 + 0x1p-40);
    return BoxIntegral{c > 0 ? corner : 4 * h * h - corner, bound};
  }

  StoredDoubles stored() const {
    StoredDoubles doubles{{"through", {through_.x, through_.y}}, {"normal", {normal_.x, normal_.y}}};
    if (motion_ != Vec2{}) doubles.push_back({"motion", {motion_.x, motion_.y}});
    return doubles;
  }

  Vec2 motion() const noexcept { return motion_; }
  // Only what goes across the edge counts: a motion along the axis that is nearer to the normal.
  Vec2 sweep() const noexcept {
    if (std::fabs(n_.x) >= std::fabs(n_.y)) return {(travel_ / Dd(n_.x)).value(), 0};
    return {0, (travel_ / Dd(n_.y)).value()};
  }

 private:
  // n . (through - origin - (shift, shift)), and what double-double may have lost: it has 100 bits of the products,
  // which is nothing unless pixel and edge are far from each other's origin along the edge.
  struct Offset {
    Dd value;
    double error;
  };
  Offset exact_offset(Pixel origin, double shift) const noexcept {
    const Dd x = from(through_.x, origin.x, shift), y = from(through_.y, origin.y, shift);
    return {Dd(n_.x) * x + Dd(n_.y) * y, 0x1p-100 * (std::fabs(n_.x * x.hi) + std::fabs(n_.y * y.hi)) + travel_error_};
  }
  static Dd from(double through, std::int64_t origin, double shift) noexcept {
    // Where the pixel is a double with its shift, the difference is exact.
    constexpr std::int64_t kFar = std::int64_t{1} << 51;
    if (-kFar < origin && origin < kFar) return two_sum(through, -(static_cast<double>(origin) + shift));
    return Dd(through) - dd_from_integer(origin) - Dd(shift);
  }
  // The same, the value rounded.
  std::pair<double, double> offset(Pixel origin, double shift) const noexcept {
    const Offset exact = exact_offset(origin, shift);
    return {exact.value.value(), exact.error};
  }

  // The sign of n . (origin + p - through - t motion), exactly.
  int exact_sign(Pixel origin, Vec2 p, double t = 0) const noexcept {
    Expansion sum;
    const Vec2 n{n_.x * 0x1p500, n_.y * 0x1p500};  // away from underflow
    const Dd ox = dd_from_integer(origin.x), oy = dd_from_integer(origin.y);
    for (const double term : {p.x, ox.hi, ox.lo, -through_.x}) sum.add_product(n.x, term);
    for (const double term : {p.y, oy.hi, oy.lo, -through_.y}) sum.add_product(n.y, term);
    if (t != 0) {
      const Dd x = two_prod(t, motion_.x), y = two_prod(t, motion_.y);
      for (const double term : {x.hi, x.lo}) sum.add_product(-n.x, term);
      for (const double term : {y.hi, y.lo}) sum.add_product(-n.y, term);
    }
    return sum.sign();
  }

  Vec2 through_, normal_, n_, motion_;
  Dd travel_;  // n . motion, and its error
  double travel_error_ = 0;
};

}  // namespace

extern constinit const TestImageInfo edge_testimage;
constinit const TestImageInfo edge_testimage =
    describe<Edge>({.name = "edge",
                    .title = "Half-plane",
                    .cite = "Mitchell, \"Ray tracing and irregularities of distribution\", 1992, section 5",
                    .params = kParams});

}  // namespace moire
