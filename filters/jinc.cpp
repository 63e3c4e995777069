// Jinc filter: the jinc in the main lobe of a wider jinc, what the Lanczos filter is when made of rings.
//
// jinc(r) = 2 J1(pi r) / (pi r), J1 the Bessel function of order 1. This is what ImageMagick's elliptical resampling
// means by Lanczos (Robidoux and Thyssen, MagickCore/resize.c); the radius is the zero of the jinc that `lobes` counts.
#include "filters/ellipse.h"
#include "filters/filter.h"
#include "filters/jinc_function.h"
#include "filters/preset.h"

namespace moire {
namespace {

constexpr Param kParams[] = {integer("lobes", 3, 1, kJincZeros, "the radius is the zero of this number"),
                             number("blur", 1, 0.5, 2, "stretches the kernel: k(r / blur); below 1 it sharpens"),
                             choice("preset", "none", "none|imagemagick-sharp|imagemagick2|imagemagick2-sharp",
                                    "a variant by its system's name; in place of the other parameters")};

struct Preset {
  std::string_view name;
  int lobes;
  double blur;
};
// ImageMagick 7: LanczosSharp, Lanczos2, Lanczos2Sharp. Its plain Lanczos is the default here.
constexpr Preset kPresets[] = {{"imagemagick-sharp", 3, 0.9812505644269356},
                               {"imagemagick2", 2, 1},
                               {"imagemagick2-sharp", 2, 0.9549963639785485}};

struct Jinc {
  int lobes;
  double blur;
  JincFunction jinc;

  explicit Jinc(const Args& a) : Jinc(a, find_preset(a, "jinc", kPresets, {"lobes", "blur"})) {}
  Jinc(const Args& a, const Preset* p)
      : lobes(p != nullptr ? p->lobes : static_cast<int>(a.integer("lobes"))),
        blur(p != nullptr ? p->blur : a.number("blur")),
        jinc(jinc_zero(lobes) + 1) {}

  std::vector<double> knots() const {
    std::vector<double> k = {0};
    for (int i = 1; i <= lobes; ++i) k.push_back(jinc_zero(i) * blur);
    return k;
  }
  int degree() const { return -1; }
  Dd shape(int, Dd r) const {
    const Dd lobe = r / Dd(blur);
    return jinc(lobe) * jinc(lobe * Dd(jinc_zero(1)) / Dd(jinc_zero(lobes)));
  }
  double ellipse_bound(int piece, double rho) const {
    const double height = Ellipse(knots(), piece, blur, rho).imaginary;
    return jinc_bound(height) * jinc_bound(height * jinc_zero(1) / jinc_zero(lobes));
  }
};

}  // namespace

extern constinit const FilterInfo jinc_filter;
constinit const FilterInfo jinc_filter =
    describe_radial<Jinc>({.name = "jinc",
                           .title = "Jinc-windowed jinc, radial",
                           .cite = "Robidoux and Thyssen, ImageMagick 7, MagickCore/resize.c",
                           .params = kParams});

}  // namespace moire
