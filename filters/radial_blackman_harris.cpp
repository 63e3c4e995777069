// Radial Blackman-Harris filter: the four-term cosine window of the distance from the centre, as OSPRay has it.
//
// Harris, "On the use of windows for harmonic analysis with the discrete Fourier transform", Proc. IEEE 66(1), 1978.
#include "filters/cosine_sum.h"
#include "filters/even_knots.h"
#include "filters/filter.h"

namespace moire {
namespace {

constexpr Param kParams[] = {number("width", 3, 0.125, 32, "diameter in pixels")};

struct RadialBlackmanHarris {
  double radius;
  explicit RadialBlackmanHarris(const Args& a) : radius(a.number("width") / 2) {}
  std::vector<double> knots() const { return even_knots_from_zero(radius, 2); }
  int degree() const { return -1; }
  Dd shape(int, Dd r) const { return cosine_sum(kBlackmanHarris, r / Dd(radius)); }
  double ellipse_bound(int piece, double rho) const {
    return cosine_sum_bound(kBlackmanHarris, Ellipse(knots(), piece, radius, rho).imaginary);
  }
};

}  // namespace

extern constinit const FilterInfo radial_blackman_harris_filter;
constinit const FilterInfo radial_blackman_harris_filter =
    describe_radial<RadialBlackmanHarris>({.name = "radial-blackman-harris",
                                           .title = "Blackman-Harris window, radial",
                                           .cite = "Harris, \"On the use of windows for harmonic analysis\", 1978",
                                           .params = kParams});

}  // namespace moire
