// Catmull-Rom filter: the interpolating cubic of the BC family, b = 0, c = 1/2.
#include "filters/bc_cubic.h"
#include "filters/filter.h"

namespace moire {
namespace {

struct CatmullRom : BcCubic {
  explicit CatmullRom(const Args&) : BcCubic{0, 0.5} {}
};

}  // namespace

extern constinit const FilterInfo catmull_rom_filter;
constinit const FilterInfo catmull_rom_filter =
    describe<CatmullRom>({.name = "catmull-rom",
                          .title = "Catmull-Rom cubic",
                          .cite = "Catmull and Rom, \"A class of local interpolating splines\", 1974",
                          .params = {}});

}  // namespace moire
