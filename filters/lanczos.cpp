// Lanczos filter: the sinc in the main lobe of a wider sinc, sinc(x) sinc(x / a) for |x| < a.
//
// Duchon, "Lanczos filtering in one and two dimensions", J. Applied Meteorology 18, 1979. Not quite a partition of
// unity: whole-image sums miss areas by its ripple, 3e-3 at a = 3.
#include "core/dd_math.h"
#include "filters/ellipse.h"
#include "filters/filter.h"
#include "filters/preset.h"

namespace moire {
namespace {

constexpr Param kParams[] = {integer("a", 3, 1, 16, "lobes to each side; the radius is a times blur pixels"),
                             number("blur", 1, 0.5, 2, "stretches the kernel: k(x / blur); below 1 it sharpens"),
                             choice("preset", "none", "none|imagemagick-sharp|imagemagick2|imagemagick2-sharp",
                                    "a variant by its system's name; in place of the other parameters")};

struct Preset {
  std::string_view name;
  int a;
  double blur;
};
// ImageMagick 7, MagickCore/resize.c: LanczosSharp, Lanczos2, Lanczos2Sharp. Its plain Lanczos is the default here.
constexpr Preset kPresets[] = {{"imagemagick-sharp", 3, 0.9812505644269356},
                               {"imagemagick2", 2, 1},
                               {"imagemagick2-sharp", 2, 0.9549963639785485}};

struct Lanczos {
  int a;
  double blur;
  explicit Lanczos(const Args& args) : a(static_cast<int>(args.integer("a"))), blur(args.number("blur")) {
    const Preset* p = find_preset(args, "lanczos", kPresets, {"a", "blur"});
    if (p == nullptr) return;
    a = p->a;
    blur = p->blur;
  }

  std::vector<double> knots() const {
    std::vector<double> k;
    for (int i = -a; i <= a; ++i) k.push_back(i * blur);
    return k;
  }
  int degree() const { return -1; }
  Dd shape(int, Dd x) const {
    const Dd lobe = x / Dd(blur);
    return dd_sinc(lobe) * dd_sinc(lobe / Dd(a));
  }
  double ellipse_bound(int piece, double rho) const {
    const double height = Ellipse(knots(), piece, blur, rho).imaginary;
    return sinc_bound(height) * sinc_bound(height / a);
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
