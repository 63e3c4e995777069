// Keys' cubic convolution: interpolating cubics with slope a at one pixel; the BC family with b = 0, c = -a.
//
// Keys, "Cubic convolution interpolation for digital image processing", IEEE Trans. Acoustics, Speech and Signal
// Processing 29(6), 1981: a = -1/2 alone is third-order accurate, and is the Catmull-Rom cubic.
#include "filters/bc_cubic.h"
#include "filters/filter.h"

namespace moire {
namespace {

constexpr Param kParams[] = {number("a", -0.5, -8, 8, "slope of the kernel at one pixel")};

struct Keys : BcCubic {
  explicit Keys(const Args& a) : BcCubic{0, -a.number("a")} {}
};

}  // namespace

extern constinit const FilterInfo keys_filter;
constinit const FilterInfo keys_filter =
    describe<Keys>({.name = "keys",
                    .title = "Keys cubic convolution",
                    .cite = "Keys, \"Cubic convolution interpolation for digital image processing\", 1981",
                    .params = kParams});

}  // namespace moire
