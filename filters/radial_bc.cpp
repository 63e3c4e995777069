// The two-parameter family of cubics as a function of the distance from the centre.
//
// Mitchell and Netravali, "Reconstruction filters in computer graphics", Computer Graphics 22(4), 1988, make them of x
// and of y; these systems make them of r.
#include "filters/bc_cubic.h"
#include "filters/filter.h"
#include "filters/preset.h"

namespace moire {
namespace {

constexpr Param kParams[] = {
    number("b", 1.0 / 3, -8, 8, "B of the family"), number("c", 1.0 / 3, -8, 8, "C of the family"),
    number("radius", 2, 0.125, 16, "radius in pixels: k(2 r / radius)"),
    choice("preset", "none",
           "none|renderman-catmull-rom|ospray-mitchell|imagemagick-robidoux|imagemagick-robidoux-sharp",
           "what a system means by a name; in place of the other parameters")};

struct Preset {
  std::string_view name;
  double b, c;
  bool clamped;  // negative values replaced by 0
};
// RenderMan Interface Specification 3.2, appendix E; OSPRay's look-up table (LUTPixelFilter), which clamps;
// ImageMagick 7, MagickCore/resize.c, whose elliptical resampling takes all its filters as radial ones.
constexpr Preset kPresets[] = {{"renderman-catmull-rom", 0, 0.5, false},
                               {"ospray-mitchell", 1.0 / 3, 1.0 / 3, true},
                               {"imagemagick-robidoux", 0.37821575509399867, 0.31089212245300067, false},
                               {"imagemagick-robidoux-sharp", 0.2620145123990142, 0.3689927438004929, false}};

struct RadialBc {
  BcCubic cubic;
  bool clamped = false;

  explicit RadialBc(const Args& a)
      : cubic{BcCubic::parameter(a.number("b")), BcCubic::parameter(a.number("c")), a.number("radius")} {
    const Preset* p = find_preset(a, "radial-bc", kPresets, {"b", "c", "radius"});
    if (p == nullptr) return;
    cubic = {BcCubic::parameter(p->b), BcCubic::parameter(p->c)};
    clamped = p->clamped;
  }

  // With B = C = 1/3 the outer cubic is s^2 (7 s / 18 - 1/3), s = 2 - r: negative from r = 8/7 on. Without these values
  // the support ends there, at the double next to it.
  std::vector<double> knots() const {
    if (clamped) return {0, 1, 8.0 / 7};
    return {0, cubic.radius / 2, cubic.radius};
  }
  int degree() const { return 3; }
  Dd shape(int piece, Dd r) const { return cubic.shape(piece == 0 ? 2 : 3, r); }
  double ellipse_bound(int, double) const { return 0; }  // a polynomial: never asked
};

}  // namespace

extern constinit const FilterInfo radial_bc_filter;
constinit const FilterInfo radial_bc_filter =
    describe_radial<RadialBc>({.name = "radial-bc",
                               .title = "Mitchell-Netravali cubic (BC family), radial",
                               .cite = "Mitchell and Netravali, \"Reconstruction filters in computer graphics\", 1988",
                               .params = kParams});

}  // namespace moire
