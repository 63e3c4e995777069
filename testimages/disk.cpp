// A disk: |p - center| <= radius. All edge directions at once, and curvature that no sampling pattern is aligned with.
#include <algorithm>

#include "core/error.h"
#include "testimages/circle.h"
#include "testimages/scene_args.h"
#include "testimages/testimage.h"

namespace moire {
namespace {

constexpr Param kParams[] = {numbers("center", true, "", "[x, y] in pixels"),
                             numbers("radius", true, "", "in pixels, above 0")};

class Disk {
 public:
  Disk(const Args& args, Grid) : circle_{point(args, "center")} {
    const Value& v = *args.find("radius");
    if (v.rank != 0 || v.numbers.size() != 1) throw Error(v.place, "\"radius\" must be one number, in pixels");
    circle_.radius = v.numbers[0];
    require_radius(v, "radius", circle_.radius);
  }

  void contains(std::span<const Pixel> run, std::span<const double> x, std::span<const double> y,
                std::span<std::uint8_t> inside) const noexcept {
    const std::size_t n = x.size() / run.size();
    std::fill(inside.begin(), inside.end(), std::uint8_t{0});
    for (std::size_t p = 0; p < run.size(); ++p) {
      mark_inside(circle_, run[p], x.subspan(p * n, n), y.subspan(p * n, n), {1, 1}, inside.subspan(p * n, n));
    }
  }

  Cover cover(Pixel origin, Rect r) const noexcept { return moire::cover(seen_from(circle_, origin, 0), r); }

  void boundary(Pixel origin, double, Boundary& out) const {
    out.circles.push_back(boundary_circle(circle_, seen_from(circle_, origin, 0.5)));
  }

  StoredDoubles stored() const {
    return {{"center", {circle_.center.x, circle_.center.y}}, {"radius", {circle_.radius}}};
  }

 private:
  GivenCircle circle_;
};

}  // namespace

extern constinit const TestImageInfo disk_testimage;
constinit const TestImageInfo disk_testimage =
    describe<Disk>({.name = "disk",
                    .title = "Disk",
                    .cite = "Mitchell, \"Ray tracing and irregularities of distribution\", 1992, section 4",
                    .params = kParams});

}  // namespace moire
