// Splines of 2, 3 or 4 cubic pieces to each side that interpolate: known as spline16, spline36 and spline64.
//
// Dersch, "Testing Interpolator Quality", 1999, for Panorama Tools; ImageMagick's CubicSpline with its lobes: what a
// natural spline through 4, 6 or 8 samples weighs each with, so that k(0) = 1 and k is 0 at the other whole pixels.
#include "core/dd_math.h"
#include "filters/filter.h"

namespace moire {
namespace {

constexpr Param kParams[] = {integer("lobes", 2, 2, 4, "cubic pieces to each side, and the radius in pixels")};

// The piece j <= |x| < j + 1 is (c[0] s^3 + c[1] s^2 + c[2] s + c[3]) / denominator, s = |x| - j.
struct Cubic {
  double c[4], denominator;
};
constexpr Cubic kPieces[3][4] = {
    {{{15, -27, -3, 15}, 15}, {{-5, 12, -7, 0}, 15}, {}, {}},
    {{{247, -453, -3, 209}, 209}, {{-114, 270, -156, 0}, 209}, {{19, -45, 26, 0}, 209}, {}},
    {{{3479, -6387, -3, 2911}, 2911},
     {{-1704, 4032, -2328, 0}, 2911},
     {{426, -1008, 582, 0}, 2911},
     {{-71, 168, -97, 0}, 2911}}};

struct CubicSpline {
  int lobes;
  explicit CubicSpline(const Args& a) : lobes(static_cast<int>(a.integer("lobes"))) {}

  std::vector<double> knots() const {
    std::vector<double> k;
    for (int i = -lobes; i <= lobes; ++i) k.push_back(i);
    return k;
  }
  int degree() const { return 3; }
  Dd shape(int piece, Dd x) const {
    const int j = piece < lobes ? lobes - 1 - piece : piece - lobes;
    const Cubic& p = kPieces[lobes - 2][j];
    const Dd s = dd_abs(x) - Dd(j);
    return (((Dd(p.c[0]) * s + Dd(p.c[1])) * s + Dd(p.c[2])) * s + Dd(p.c[3])) / Dd(p.denominator);
  }
  double ellipse_bound(int, double) const { return 0; }  // a polynomial: never asked
};

}  // namespace

extern constinit const FilterInfo cubic_spline_filter;
constinit const FilterInfo cubic_spline_filter =
    describe<CubicSpline>({.name = "cubic-spline",
                           .title = "Interpolating cubic spline (spline16, spline36, spline64)",
                           .cite = "Dersch, \"Testing Interpolator Quality\", 1999",
                           .params = kParams});

}  // namespace moire
