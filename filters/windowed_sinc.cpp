// The sinc under a window: sinc(x) w(x / radius), cut where the window ends.
//
// Harris, "On the use of windows for harmonic analysis with the discrete Fourier transform", Proc. IEEE 66(1), 1978;
// the windows are in window.h. The sinc's own main lobe as a window makes the lanczos filter.
#include <algorithm>
#include <cmath>

#include "core/dd_math.h"
#include "filters/ellipse.h"
#include "filters/even_knots.h"
#include "filters/filter.h"
#include "filters/preset.h"
#include "filters/window.h"

namespace moire {
namespace {

constexpr Param kParams[] = {
    choice("window", "hann", kWindowNames, "by what the sinc is multiplied"),
    number("radius", 3, 1, 16, "half width in pixels, of the window and of the kernel"),
    number("beta", 6.5, 0, 32, "of the Kaiser window: 0 no window, more a stronger one"),
    choice("preset", "none", "none|imagemagick", "a system's radius and beta for the window; in place of these")};

// ImageMagick 7, MagickCore/resize.c: support 4, but 3 for two windows.
struct Preset {
  std::string_view name;
  double radius, short_radius, beta;
};
constexpr Preset kPresets[] = {{"imagemagick", 4, 3, 6.5}};

struct WindowedSinc {
  double radius;
  Window window;

  explicit WindowedSinc(const Args& a) : radius(a.number("radius")), window(a.text("window"), a.number("beta")) {
    const Preset* p = find_preset(a, "windowed-sinc", kPresets, {"radius", "beta"});
    if (p == nullptr) return;
    const std::string_view name = a.text("window");
    radius = name == "welch" || name == "cosine" ? p->short_radius : p->radius;
    window = Window(name, p->beta);
  }

  // At most one pixel and half a radius long, which bounds the degree for any window.
  std::vector<double> knots() const {
    if (window.breaks_halfway()) return even_knots(radius, 2 * static_cast<int>(std::ceil(radius / 2)));
    return even_knots(radius, std::max(2, static_cast<int>(std::ceil(radius))));
  }
  int degree() const { return -1; }
  Dd shape(int, Dd x) const { return dd_sinc(x) * window(x / Dd(radius)); }
  double ellipse_bound(int piece, double rho) const {
    const std::vector<double> k = knots();
    return sinc_bound(Ellipse(k, piece, 1, rho).imaginary) * window.ellipse_bound(Ellipse(k, piece, radius, rho));
  }
};

}  // namespace

extern constinit const FilterInfo windowed_sinc_filter;
constinit const FilterInfo windowed_sinc_filter =
    describe<WindowedSinc>({.name = "windowed-sinc",
                            .title = "Windowed sinc",
                            .cite = "Harris, \"On the use of windows for harmonic analysis\", 1978",
                            .params = kParams});

}  // namespace moire
