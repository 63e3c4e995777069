// Simon's filter: cubic convolution with a = -3/4, the cubic of the BC family with b = 0, c = 3/4.
//
// Simon, "Digital image reconstruction and resampling for geometric manipulation", Proc. Symposium on Machine
// Processing of Remotely Sensed Data, 1975: the slope -3/4 at one pixel, after which OpenImageIO names it.
#include "filters/bc_cubic.h"
#include "filters/filter.h"

namespace moire {
namespace {

struct Simon : BcCubic {
  explicit Simon(const Args&) : BcCubic{0, 0.75} {}
};

}  // namespace

extern constinit const FilterInfo simon_filter;
constinit const FilterInfo simon_filter =
    describe<Simon>({.name = "simon",
                     .title = "Simon cubic (a = -3/4)",
                     .cite = "Simon, \"Digital image reconstruction and resampling for geometric manipulation\", 1975",
                     .params = {}});

}  // namespace moire
