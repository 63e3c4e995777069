// Gaussian filter, cut at its radius: exp(-x^2 / 2 sigma^2), by default lowered so that it ends at zero.
//
// The defaults are pbrt's (Pharr, Jakob and Humphreys, "Physically Based Rendering", 4th ed., 2023): sigma = 1/2,
// radius 3/2, offset. Other systems mean other filters by the same name.
#include <numbers>

#include "filters/even_knots.h"
#include "filters/filter.h"
#include "filters/gaussian_shape.h"
#include "filters/preset.h"

namespace moire {
namespace {

constexpr Param kParams[] = {
    number("sigma", 0.5, 0.05, 16, "standard deviation in pixels, before cutting"),
    number("radius", 1.5, 0.0625, 16, "half width in pixels"),
    choice("cut", "offset", "cut|offset", "at the radius: jump to zero, or lowered to zero"),
    choice("preset", "none", "none|pbrt|mitsuba|imagemagick|ospray|renderman|arnold|cycles|oiio|oiio-sharp",
           "what a system means by its default Gaussian; in place of the other parameters")};

// A Gaussian as a system has it, at that system's default width.
struct Preset {
  std::string_view name;
  double sigma, radius;
  bool offset;
};
// Read in the systems' sources and manuals: pbrt-v4, Mitsuba 3 (as documented; its CPU code is a
// polynomial that is off by up to 1e-3), ImageMagick 7, OSPRay's look-up table at width 3, the
// RenderMan Interface's 2 x 2 filter and Arnold's width 2 after it, Cycles at width 1.5, OpenImageIO 2.4 at its widths
// 3 (sigma = width / 4) and 2 (exp(-4 x^2)).
constexpr Preset kPresets[] = {{"pbrt", 0.5, 1.5, true},
                               {"mitsuba", 0.5, 2, true},
                               {"imagemagick", 0.5, 2, false},
                               {"ospray", 0.5, 1.5, false},
                               {"renderman", 0.5, 1, false},
                               {"arnold", 0.5, 1, false},
                               {"cycles", 0.375, 2.25, false},
                               {"oiio", 0.75, 1.5, false},
                               {"oiio-sharp", 0.5 * std::numbers::sqrt2 / 2, 1, false}};

struct Gaussian : GaussianShape {
  explicit Gaussian(const Args& a) : GaussianShape{a.number("sigma"), a.number("radius"), a.text("cut") == "offset"} {
    const Preset* p = find_preset(a, "gaussian", kPresets, {"sigma", "radius", "cut"});
    if (p == nullptr) return;
    sigma = p->sigma;
    radius = p->radius;
    offset = p->offset;
  }

  std::vector<double> knots() const { return even_knots(radius, pieces_to_a_side()); }
};

}  // namespace

extern constinit const FilterInfo gaussian_filter;
constinit const FilterInfo gaussian_filter =
    describe<Gaussian>({.name = "gaussian",
                        .title = "Gaussian (defaults as in pbrt)",
                        .cite = "Pharr, Jakob and Humphreys, \"Physically Based Rendering\", 4th ed., 2023",
                        .params = kParams});

}  // namespace moire
