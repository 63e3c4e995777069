// Cone filter: linear in r from the centre to zero at the radius.
//
// Gupta and Sproull, "Filtering edges for gray-scale displays", Computer Graphics 15(3), 1981, with a radius of 1.
#include "filters/filter.h"

namespace moire {
namespace {

constexpr Param kParams[] = {number("radius", 1, 0.0625, 16, "radius in pixels")};

struct Cone {
  double radius;
  explicit Cone(const Args& a) : radius(a.number("radius")) {}
  std::vector<double> knots() const { return {0, radius}; }
  int degree() const { return 1; }
  Dd shape(int, Dd r) const { return Dd(radius) - r; }
  double ellipse_bound(int, double) const { return 0; }  // a polynomial: never asked
};

}  // namespace

extern constinit const FilterInfo cone_filter;
constinit const FilterInfo cone_filter =
    describe_radial<Cone>({.name = "cone",
                           .title = "Cone, radial",
                           .cite = "Gupta and Sproull, \"Filtering edges for gray-scale displays\", 1981",
                           .params = kParams});

}  // namespace moire
