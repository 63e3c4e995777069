// Radial Gaussian filter, cut at a disk's rim: exp(-r^2 / 2 sigma^2), by default lowered so that it ends at zero.
//
// Uncut it would be the separable Gaussian; the two differ by where and how they end.
#include "filters/even_knots.h"
#include "filters/filter.h"
#include "filters/gaussian_shape.h"

namespace moire {
namespace {

constexpr Param kParams[] = {number("sigma", 0.5, 0.05, 16, "standard deviation in pixels, before cutting"),
                             number("radius", 1.5, 0.0625, 16, "radius in pixels"),
                             choice("cut", "offset", "cut|offset", "at the radius: jump to zero, or lowered to zero")};

struct RadialGaussian : GaussianShape {
  explicit RadialGaussian(const Args& a)
      : GaussianShape{a.number("sigma"), a.number("radius"), a.text("cut") == "offset"} {}
  std::vector<double> knots() const { return even_knots_from_zero(radius, pieces_to_a_side()); }
};

}  // namespace

extern constinit const FilterInfo radial_gaussian_filter;
constinit const FilterInfo radial_gaussian_filter =
    describe_radial<RadialGaussian>({.name = "radial-gaussian",
                                     .title = "Gaussian, radial",
                                     .cite = "Heckbert, \"Fundamentals of Texture Mapping\", 1989",
                                     .params = kParams});

}  // namespace moire
