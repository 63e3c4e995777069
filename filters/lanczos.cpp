// Lanczos filter: the sinc in the main lobe of a wider sinc, sinc(x) sinc(x / a) for |x| < a.
//
// Duchon, "Lanczos filtering in one and two dimensions", J. Applied Meteorology 18, 1979. Not quite a partition of
// unity: whole-image sums miss areas by its ripple, 3e-3 at a = 3.
#include <cmath>
#include <numbers>

#include "core/dd_math.h"
#include "filters/filter.h"

namespace moire {
namespace {

constexpr Param kParams[] = {integer("a", 3, 1, 16, "lobes to each side, and the radius in pixels")};

struct Lanczos {
  int a;
  explicit Lanczos(const Args& args) : a(static_cast<int>(args.integer("a"))) {}

  std::vector<double> knots() const {
    std::vector<double> k;
    for (int i = -a; i <= a; ++i) k.push_back(i);
    return k;
  }
  int degree() const { return -1; }
  Dd shape(int, Dd x) const { return dd_sinc(x) * dd_sinc(x / Dd(a)); }

  // sinc(z) is the mean of exp(2 pi i t z) over |t| <= 1/2, so |sinc(z)| <= exp(pi |Im z|). Pieces are one pixel long.
  double ellipse_bound(int, double rho) const {
    const double height = 0.5 * (rho - 1 / rho) / 2;
    return std::exp(std::numbers::pi * height * (1 + 1.0 / a));
  }
};

}  // namespace

extern constinit const FilterInfo lanczos_filter;
constinit const FilterInfo lanczos_filter =
    describe<Lanczos>({.name = "lanczos",
                       .title = "Lanczos-windowed sinc",
                       .cite = "Duchon, \"Lanczos filtering in one and two dimensions\", 1979",
                       .params = kParams});

}  // namespace moire
