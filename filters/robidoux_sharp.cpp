// Robidoux sharp filter: a cubic of the BC family on the line b + 2 c = 1, between Mitchell and Catmull-Rom.
//
// N. Robidoux for ImageMagick; b and c are those of ImageMagick 7, MagickCore/resize.c.
#include "filters/bc_cubic.h"
#include "filters/filter.h"

namespace moire {
namespace {

struct RobidouxSharp : BcCubic {
  explicit RobidouxSharp(const Args&) : BcCubic{0.2620145123990142, 0.3689927438004929} {}
};

}  // namespace

extern constinit const FilterInfo robidoux_sharp_filter;
constinit const FilterInfo robidoux_sharp_filter =
    describe<RobidouxSharp>({.name = "robidoux-sharp",
                             .title = "Robidoux sharp cubic",
                             .cite = "Thyssen, \"ImageMagick Examples: Resampling Filters\", 2012",
                             .params = {}});

}  // namespace moire
