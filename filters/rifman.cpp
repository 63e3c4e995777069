// Rifman's filter: cubic convolution with a = -1, the cubic of the BC family with b = 0, c = 1.
//
// Rifman, "Digital rectification of ERTS multispectral imagery", Proc. Symposium on Significant Results Obtained from
// ERTS-1, 1973: the slope of sinc at one pixel.
#include "filters/bc_cubic.h"
#include "filters/filter.h"

namespace moire {
namespace {

struct Rifman : BcCubic {
  explicit Rifman(const Args&) : BcCubic{0, 1} {}
};

}  // namespace

extern constinit const FilterInfo rifman_filter;
constinit const FilterInfo rifman_filter =
    describe<Rifman>({.name = "rifman",
                      .title = "Rifman cubic (a = -1)",
                      .cite = "Rifman, \"Digital rectification of ERTS multispectral imagery\", 1973",
                      .params = {}});

}  // namespace moire
