// The sinc, cut off at a radius: what sampling theory asks for and what must not be done to it. A bad example.
//
// Shannon, "Communication in the presence of noise", Proc. IRE 37(1), 1949. Cutting makes it ring, jump at the ends
// (where the radius is no whole number) and miss the partition of unity by a tenth.
#include <cmath>

#include "core/dd_math.h"
#include "filters/ellipse.h"
#include "filters/even_knots.h"
#include "filters/filter.h"
#include "filters/preset.h"

namespace moire {
namespace {

constexpr Param kParams[] = {
    number("radius", 2, 0.5, 16, "half width in pixels, where the sinc is cut"),
    choice("preset", "none", "none|oiio|imagemagick|renderman",
           "what a system means by its default sinc, renderman sin(x)/x; in place of the radius")};

struct Preset {
  std::string_view name;
  double radius;
  bool pi;  // sin(pi x) / (pi x), or sin(x) / x
};
// OpenImageIO 2.4 at its default width 4; ImageMagick 7 at its support 4; the RenderMan Interface Specification 3.2,
// appendix E, whose filter has no pi. Its width is the caller's; 4 is taken here.
constexpr Preset kPresets[] = {{"oiio", 2, true}, {"imagemagick", 4, true}, {"renderman", 2, false}};

struct Sinc {
  double radius;
  bool pi = true;
  explicit Sinc(const Args& a) : radius(a.number("radius")) {
    const Preset* p = find_preset(a, "sinc", kPresets, {"radius"});
    if (p == nullptr) return;
    radius = p->radius;
    pi = p->pi;
  }

  std::vector<double> knots() const { return even_knots(radius, static_cast<int>(std::ceil(radius))); }
  int degree() const { return -1; }
  Dd shape(int, Dd x) const { return dd_sinc(pi ? x : x / kPi); }
  // Also for sin(x) / x, which grows less.
  double ellipse_bound(int piece, double rho) const { return sinc_bound(Ellipse(knots(), piece, 1, rho).imaginary); }
};

}  // namespace

extern constinit const FilterInfo sinc_filter;
constinit const FilterInfo sinc_filter =
    describe<Sinc>({.name = "sinc",
                    .title = "Truncated sinc",
                    .cite = "Shannon, \"Communication in the presence of noise\", 1949",
                    .params = kParams});

}  // namespace moire
