// Robidoux filter: a cubic of the BC family close to Mitchell's, made to be used radially.
//
// N. Robidoux for ImageMagick, where it is the default of distortions: without a change of size it keeps images of
// vertical or of horizontal lines as they are. b and c are those of ImageMagick 7, MagickCore/resize.c; b + 2 c = 1.
// Here it is separable, as ImageMagick's own resizing is.
#include "filters/bc_cubic.h"
#include "filters/filter.h"

namespace moire {
namespace {

struct Robidoux : BcCubic {
  explicit Robidoux(const Args&) : BcCubic{0.37821575509399867, 0.31089212245300067} {}
};

}  // namespace

extern constinit const FilterInfo robidoux_filter;
constinit const FilterInfo robidoux_filter =
    describe<Robidoux>({.name = "robidoux",
                        .title = "Robidoux cubic",
                        .cite = "Thyssen, \"ImageMagick Examples: Resampling Filters\", 2012",
                        .params = {}});

}  // namespace moire
