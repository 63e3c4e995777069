// Box filter: the plain mean over a square, one pixel wide by default.
#include "filters/filter.h"

namespace moire {
namespace {

constexpr Param kParams[] = {number("width", 1, 0.0625, 16, "full width in pixels")};

struct Box {
  double radius;
  explicit Box(const Args& a) : radius(a.number("width") / 2) {}
  std::vector<double> knots() const { return {-radius, radius}; }
  int degree() const { return 0; }
  Dd shape(int, Dd) const { return 1.0; }
  double ellipse_bound(int, double) const { return 0; }  // a polynomial: never asked
};

}  // namespace

extern constinit const FilterInfo box_filter;
constinit const FilterInfo box_filter = describe<Box>(
    {.name = "box", .title = "Box", .cite = "Heckbert, \"Fundamentals of Texture Mapping\", 1989", .params = kParams});

}  // namespace moire
