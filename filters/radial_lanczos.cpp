// Radial Lanczos filter: sinc(r) sinc(r / a) for r < a, as OpenImageIO has it (radial-lanczos3).
//
// Duchon, "Lanczos filtering in one and two dimensions", J. Applied Meteorology 18, 1979.
#include "core/dd_math.h"
#include "filters/ellipse.h"
#include "filters/even_knots.h"
#include "filters/filter.h"

namespace moire {
namespace {

constexpr Param kParams[] = {integer("a", 3, 1, 16, "lobes; the radius in pixels")};

struct RadialLanczos {
  int a;
  explicit RadialLanczos(const Args& args) : a(static_cast<int>(args.integer("a"))) {}
  std::vector<double> knots() const { return even_knots_from_zero(a, a); }
  int degree() const { return -1; }
  Dd shape(int, Dd r) const { return dd_sinc(r) * dd_sinc(r / Dd(a)); }
  double ellipse_bound(int piece, double rho) const {
    const double height = Ellipse(knots(), piece, 1, rho).imaginary;
    return sinc_bound(height) * sinc_bound(height / a);
  }
};

}  // namespace

extern constinit const FilterInfo radial_lanczos_filter;
constinit const FilterInfo radial_lanczos_filter =
    describe_radial<RadialLanczos>({.name = "radial-lanczos",
                                    .title = "Lanczos-windowed sinc, radial",
                                    .cite = "Duchon, \"Lanczos filtering in one and two dimensions\", 1979",
                                    .params = kParams});

}  // namespace moire
