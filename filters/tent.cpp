// Tent (triangle, Bartlett) filter: linear from the centre to zero at the radius; the box convolved with itself.
#include "core/dd_math.h"
#include "filters/filter.h"
#include "filters/preset.h"

namespace moire {
namespace {

constexpr Param kParams[] = {number("radius", 1, 0.0625, 16, "half width in pixels"),
                             choice("preset", "none", "none|pbrt", "what a system means by its default triangle")};

struct Preset {
  std::string_view name;
  double radius;
};
constexpr Preset kPresets[] = {{"pbrt", 2}};  // pbrt-v4, filters.cpp: four pixels wide

struct Tent {
  double radius;
  explicit Tent(const Args& a) : radius(a.number("radius")) {
    if (const Preset* p = find_preset(a, "tent", kPresets, {"radius"})) radius = p->radius;
  }
  std::vector<double> knots() const { return {-radius, 0, radius}; }
  int degree() const { return 1; }
  Dd shape(int, Dd x) const { return Dd(radius) - dd_abs(x); }
  double ellipse_bound(int, double) const { return 0; }  // a polynomial: never asked
};

}  // namespace

extern constinit const FilterInfo tent_filter;
constinit const FilterInfo tent_filter = describe<Tent>({.name = "tent",
                                                         .title = "Tent (triangle)",
                                                         .cite = "Pharr, Jakob and Humphreys, \"PBR\", 4th ed., 2023",
                                                         .params = kParams});

}  // namespace moire
