// Cubic o-MOMS: of all kernels of its order and support the one with the smallest error of approximation.
//
// Blu, Thevenaz and Unser, "MOMS: maximal-order interpolation of minimal support", IEEE Trans. Image Processing 10(7),
// 2001: the cubic B-spline plus 1/42 of its second derivative. It was made to interpolate after a digital prefilter;
// here it weighs samples as it is. Continuous, with a kink at each knot.
#include "core/dd_math.h"
#include "filters/filter.h"

namespace moire {
namespace {

struct OMoms {
  explicit OMoms(const Args&) {}
  std::vector<double> knots() const { return {-2, -1, 0, 1, 2}; }
  int degree() const { return 3; }

  // B(x) + B''(x) / 42, outside one pixel in s = 2 - |x|.
  Dd shape(int piece, Dd x) const {
    const Dd a = dd_abs(x), ratio = Dd(1) / Dd(42);
    if (piece == 1 || piece == 2) {
      return (Dd(0.5) * a - Dd(1)) * a * a + Dd(2) / Dd(3) + ratio * (Dd(3) * a - Dd(2));
    }
    const Dd s = Dd(2) - a;
    return s * s * s / Dd(6) + ratio * s;
  }
  double ellipse_bound(int, double) const { return 0; }  // a polynomial: never asked
};

}  // namespace

extern constinit const FilterInfo o_moms_filter;
constinit const FilterInfo o_moms_filter =
    describe<OMoms>({.name = "o-moms",
                     .title = "Cubic o-MOMS",
                     .cite = "Blu, Thevenaz and Unser, \"MOMS: maximal-order interpolation of minimal support\", 2001",
                     .params = {}});

}  // namespace moire
