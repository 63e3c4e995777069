// Disk filter: the plain mean over a disk, one pixel across by default.
#include "filters/filter.h"

namespace moire {
namespace {

constexpr Param kParams[] = {number("radius", 0.5, 0.0625, 16, "radius in pixels")};

struct DiskFilter {
  double radius;
  explicit DiskFilter(const Args& a) : radius(a.number("radius")) {}
  std::vector<double> knots() const { return {0, radius}; }
  int degree() const { return 0; }
  Dd shape(int, Dd) const { return 1.0; }
  double ellipse_bound(int, double) const { return 0; }  // a polynomial: never asked
};

}  // namespace

extern constinit const FilterInfo disk_filter;
constinit const FilterInfo disk_filter = describe_radial<DiskFilter>({.name = "disk",
                                                                      .title = "Disk (pillbox), radial",
                                                                      .cite = "OpenImageIO, src/libutil/filter.cpp",
                                                                      .params = kParams});

}  // namespace moire
