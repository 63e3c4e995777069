// A disk: |p - center| <= radius. All edge directions at once, and curvature that no sampling pattern is aligned with.
#include <algorithm>
#include <cmath>

#include "core/double_double.h"
#include "core/expansion.h"
#include "testimages/scene_args.h"
#include "testimages/testimage.h"

namespace moire {
namespace {

constexpr double kUnit = 0x1p-53;

constexpr Param kParams[] = {numbers("center", true, "", "[x, y] in pixels"),
                             numbers("radius", true, "", "in pixels, above 0")};

// The circle seen from a point: p is inside when x (x - 2 cx) + y (y - 2 cy) <= power, all relative to that point. power =
// R^2 - |c|^2 comes from double-double, so that nothing cancels for large disks far away.
struct Local {
  Dd cx, cy;
  double power;

  double excess(double x, double y) const {
    return x * (x - 2 * cx.hi) + y * (y - 2 * cy.hi) - power;
  }
  // Bound on the rounding error of excess() for |x| <= ax, |y| <= ay: 3 u for each product (the centre's rounding among
  // them), 2 u for the sums, 2 u for the power.
  double doubt(double ax, double ay) const {
    return 8 * kUnit * (ax * (ax + 2 * std::fabs(cx.hi)) + ay * (ay + 2 * std::fabs(cy.hi)) + std::fabs(power));
  }
};

class Disk {
 public:
  Disk(const Args& args, Grid) : center_(point(args, "center")) {
    const Value& v = *args.find("radius");
    if (v.rank != 0 || v.numbers.size() != 1) throw Error(v.place, "\"radius\" must be one number, in pixels");
    radius_ = v.numbers[0];
    require_within(v, "radius", radius_);
    // Squares of smaller radii come near the smallest normal number.
    if (!(radius_ >= 1e-100)) {
      throw Error(v.place, "\"radius\" is " + shortest(radius_) + "; it must be at least 1e-100 pixels");
    }
  }

  void contains(std::span<const Pixel> run, std::span<const double> x, std::span<const double> y,
                std::span<std::uint8_t> inside) const noexcept {
    const std::size_t n = x.size() / run.size();
    for (std::size_t p = 0; p < run.size(); ++p) {
      const Local at = local(run[p], 0);
      const double doubt = at.doubt(1, 1);
      bool doubtful = false;
      const std::size_t end = (p + 1) * n;
      for (std::size_t i = p * n; i < end; ++i) {
        const double e = at.excess(x[i], y[i]);
        inside[i] = e <= 0;
        doubtful |= std::fabs(e) <= doubt;
      }
      if (!doubtful) continue;
      for (std::size_t i = p * n; i < end; ++i) {
        if (std::fabs(at.excess(x[i], y[i])) <= doubt) inside[i] = exact_sign(run[p], {x[i], y[i]}) <= 0;
      }
    }
  }

  Cover cover(Pixel origin, Rect r) const noexcept {
    const Local at = local(origin, 0);
    const double ax = std::max(std::fabs(r.lo.x), std::fabs(r.hi.x)), ay = std::max(std::fabs(r.lo.y), std::fabs(r.hi.y));
    const double doubt = at.doubt(ax, ay);
    // The excess grows with the distance to the centre: nearest point and farthest corner decide.
    const double near = at.excess(std::clamp(at.cx.hi, r.lo.x, r.hi.x), std::clamp(at.cy.hi, r.lo.y, r.hi.y));
    if (near > doubt) return Cover::none;
    const double far = at.excess(at.cx.hi - r.lo.x > r.hi.x - at.cx.hi ? r.lo.x : r.hi.x,
                                 at.cy.hi - r.lo.y > r.hi.y - at.cy.hi ? r.lo.y : r.hi.y);
    return far < -doubt ? Cover::all : Cover::partial;
  }

  void boundary(Pixel origin, double, Boundary& out) const {
    const Local at = local(origin, 0.5);
    out.circles.push_back({{at.cx.hi, at.cy.hi}, {at.cx.lo, at.cy.lo}, radius_, at.power});
  }

  StoredDoubles stored() const { return {{"center", {center_.x, center_.y}}, {"radius", {radius_}}}; }

 private:
  Local local(Pixel origin, double shift) const noexcept {
    const Dd cx = Dd(center_.x) - dd_from_integer(origin.x) - Dd(shift);
    const Dd cy = Dd(center_.y) - dd_from_integer(origin.y) - Dd(shift);
    return {cx, cy, (two_prod(radius_, radius_) - cx * cx - cy * cy).value()};
  }

  // The sign of |origin + p - center|^2 - radius^2, exactly.
  int exact_sign(Pixel origin, Vec2 p) const noexcept {
    Expansion sum;
    const Dd ox = dd_from_integer(origin.x), oy = dd_from_integer(origin.y);
    const double terms[2][4] = {{p.x, ox.hi, ox.lo, -center_.x}, {p.y, oy.hi, oy.lo, -center_.y}};
    for (const auto& t : terms) {
      for (int i = 0; i < 4; ++i) {
        sum.add_product(t[i], t[i]);
        for (int j = i + 1; j < 4; ++j) sum.add_product(2 * t[i], t[j]);
      }
    }
    sum.add_product(-radius_, radius_);
    return sum.sign();
  }

  Vec2 center_;
  double radius_ = 0;
};

}  // namespace

extern constinit const TestImageInfo disk_testimage;
constinit const TestImageInfo disk_testimage =
    describe<Disk>({.name = "disk",
                    .title = "Disk",
                    .cite = "Mitchell, \"Ray tracing and irregularities of distribution\", 1992, section 4",
                    .params = kParams});

}  // namespace moire
