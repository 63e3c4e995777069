// Blackman-Harris filter: the four-term cosine window used as a kernel, as renderers do.
//
// Harris, "On the use of windows for harmonic analysis with the discrete Fourier transform", Proc. IEEE 66(1), 1978:
// the minimum four-term window, side lobes below -92 dB. At a width of 4 pixels it is a partition of unity.
#include <cmath>
#include <numbers>

#include "core/dd_math.h"
#include "filters/filter.h"

namespace moire {
namespace {

constexpr Param kParams[] = {number("width", 4, 0.125, 32, "full width in pixels")};
constexpr double kTerms[] = {0.35875, 0.48829, 0.14128, 0.01168};

struct BlackmanHarris {
  double radius;
  explicit BlackmanHarris(const Args& a) : radius(a.number("width") / 2) {}

  std::vector<double> knots() const { return {-radius, -radius / 2, 0, radius / 2, radius}; }
  int degree() const { return -1; }

  // cos(m pi x / R) by the Chebyshev recurrence in cos(pi x / R): |x| <= R, so one cosine of at most pi.
  Dd shape(int, Dd x) const {
    const Dd c = dd_cos_pi(x / Dd(radius));
    const Dd c2 = Dd(2) * c * c - Dd(1), c3 = c * (Dd(2) * c2 - Dd(1));
    return Dd(kTerms[0]) + Dd(kTerms[1]) * c + Dd(kTerms[2]) * c2 + Dd(kTerms[3]) * c3;
  }

  // |cos(z)| <= cosh(Im z); a piece is half a radius long.
  double ellipse_bound(int, double rho) const {
    const double height = std::numbers::pi * 0.25 * (rho - 1 / rho) / 2;
    double sum = 0;
    for (int m = 0; m < 4; ++m) sum += kTerms[m] * std::cosh(m * height);
    return sum;
  }
};

}  // namespace

extern constinit const FilterInfo blackman_harris_filter;
constinit const FilterInfo blackman_harris_filter =
    describe<BlackmanHarris>({.name = "blackman-harris",
                              .title = "Blackman-Harris window",
                              .cite = "Harris, \"On the use of windows for harmonic analysis\", 1978",
                              .params = kParams});

}  // namespace moire
