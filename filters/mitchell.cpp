// Mitchell-Netravali filter and, by its parameters, the whole BC family of cubics; pbrt stretches it by a radius.
#include "filters/bc_cubic.h"
#include "filters/filter.h"

namespace moire {
namespace {

constexpr Param kParams[] = {number("b", 1.0 / 3, -8, 8, "B of the family; 1 with c = 0 is the cubic B-spline"),
                             number("c", 1.0 / 3, -8, 8, "C of the family; b + 2 c = 1 keeps second-order accuracy"),
                             number("radius", 2, 0.125, 16, "half width in pixels: k(2 x / radius)")};

struct Mitchell : BcCubic {
  explicit Mitchell(const Args& a) : BcCubic{parameter(a.number("b")), parameter(a.number("c")), a.number("radius")} {}
};

}  // namespace

extern constinit const FilterInfo mitchell_filter;
constinit const FilterInfo mitchell_filter =
    describe<Mitchell>({.name = "mitchell",
                        .title = "Mitchell-Netravali cubic (BC family)",
                        .cite = "Mitchell and Netravali, \"Reconstruction filters in computer graphics\", 1988",
                        .params = kParams});

}  // namespace moire
