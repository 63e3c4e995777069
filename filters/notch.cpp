// Notch filter: the cubic of the BC family with b = 3/2, c = -1/4, whose response is zero at the Nyquist frequency.
//
// Mitchell and Netravali, "Reconstruction filters in computer graphics", Computer Graphics 22(4), 1988: it suppresses
// the ripple of the sample frequency at the price of blur.
#include "filters/bc_cubic.h"
#include "filters/filter.h"

namespace moire {
namespace {

struct Notch : BcCubic {
  explicit Notch(const Args&) : BcCubic{1.5, -0.25} {}
};

}  // namespace

extern constinit const FilterInfo notch_filter;
constinit const FilterInfo notch_filter =
    describe<Notch>({.name = "notch",
                     .title = "Notch cubic (b = 3/2, c = -1/4)",
                     .cite = "Mitchell and Netravali, \"Reconstruction filters in computer graphics\", 1988",
                     .params = {}});

}  // namespace moire
