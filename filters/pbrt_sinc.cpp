// The windowed sinc of pbrt: sinc(x) sinc(x / tau), cut at a radius that need not be tau.
//
// Pharr, Jakob and Humphreys, "Physically Based Rendering", 4th ed., 2023; radius 4 and tau 3 are its defaults. Where
// the radius is above tau the window goes negative at the end, and the kernel is worse than Lanczos at a = tau.
#include <cmath>

#include "core/dd_math.h"
#include "filters/ellipse.h"
#include "filters/even_knots.h"
#include "filters/filter.h"

namespace moire {
namespace {

constexpr Param kParams[] = {number("radius", 4, 0.5, 16, "half width in pixels, where the kernel is cut"),
                             number("tau", 3, 1, 1024, "half width of the window's main lobe in pixels")};

struct PbrtSinc {
  double radius, tau;
  explicit PbrtSinc(const Args& a) : radius(a.number("radius")), tau(a.number("tau")) {}

  std::vector<double> knots() const { return even_knots(radius, static_cast<int>(std::ceil(radius))); }
  int degree() const { return -1; }
  Dd shape(int, Dd x) const { return dd_sinc(x) * dd_sinc(x / Dd(tau)); }
  double ellipse_bound(int piece, double rho) const {
    const double height = Ellipse(knots(), piece, 1, rho).imaginary;
    return sinc_bound(height) * sinc_bound(height / tau);
  }
};

}  // namespace

extern constinit const FilterInfo pbrt_sinc_filter;
constinit const FilterInfo pbrt_sinc_filter =
    describe<PbrtSinc>({.name = "pbrt-sinc",
                        .title = "Windowed sinc of pbrt",
                        .cite = "Pharr, Jakob and Humphreys, \"Physically Based Rendering\", 4th ed., 2023",
                        .params = kParams});

}  // namespace moire
