// Hermite filter: the cubic of the BC family with b = c = 0, a smooth step to either side.
//
// Its outer pieces vanish, so that its radius is 1. OpenImageIO calls it "cubic"; ImageMagick knows it as Hermite.
#include "filters/bc_cubic.h"
#include "filters/filter.h"

namespace moire {
namespace {

struct Hermite : BcCubic {
  explicit Hermite(const Args&) : BcCubic{0, 0} {}
  std::vector<double> knots() const { return {-1, 0, 1}; }
  Dd shape(int piece, Dd x) const { return BcCubic::shape(piece + 1, x); }
};

}  // namespace

extern constinit const FilterInfo hermite_filter;
constinit const FilterInfo hermite_filter =
    describe<Hermite>({.name = "hermite",
                       .title = "Hermite cubic (b = c = 0)",
                       .cite = "Mitchell and Netravali, \"Reconstruction filters in computer graphics\", 1988",
                       .params = {}});

}  // namespace moire
