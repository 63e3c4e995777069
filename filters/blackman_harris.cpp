// Blackman-Harris filter: the four-term cosine window used as a kernel, as renderers do.
//
// Harris, "On the use of windows for harmonic analysis with the discrete Fourier transform", Proc. IEEE 66(1), 1978.
// At a width of 4 pixels it is a partition of unity.
#include "filters/cosine_sum.h"
#include "filters/even_knots.h"
#include "filters/filter.h"
#include "filters/preset.h"

namespace moire {
namespace {

constexpr Param kParams[] = {
    number("width", 4, 0.125, 32, "full width in pixels"),
    choice("preset", "none", "none|oiio|cycles", "what a system means by its default width; in place of the width")};

struct Preset {
  std::string_view name;
  double width;
};
// OpenImageIO 2.4's default width; Cycles doubles its width (scene/film.cpp), which Blender sets to 1.5 pixels.
constexpr Preset kPresets[] = {{"oiio", 3}, {"cycles", 3}};

struct BlackmanHarris {
  double radius;
  explicit BlackmanHarris(const Args& a) : radius(a.number("width") / 2) {
    if (const Preset* p = find_preset(a, "blackman-harris", kPresets, {"width"})) radius = p->width / 2;
  }

  std::vector<double> knots() const { return even_knots(radius, 2); }
  int degree() const { return -1; }
  Dd shape(int, Dd x) const { return cosine_sum(kBlackmanHarris, x / Dd(radius)); }
  double ellipse_bound(int piece, double rho) const {
    return cosine_sum_bound(kBlackmanHarris, Ellipse(knots(), piece, radius, rho).imaginary);
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
