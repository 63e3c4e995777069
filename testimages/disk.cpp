// A disk: |p - center| <= radius. All edge directions at once, and curvature that no sampling pattern is aligned with.
#include <algorithm>

#include "core/error.h"
#include "testimages/circle.h"
#include "testimages/scene_args.h"
#include "testimages/testimage.h"

namespace moire {
namespace {

constexpr Param kParams[] = {numbers("center", true, "", "[x, y] in pixels"),
                             numbers("radius", true, "", "in pixels, above 0"), motion_param()};

class Disk {
 public:
  Disk(const Args& args, Grid) : circle_{point(args, "center")}, motion_(moire::motion(args)) {
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

  void contains_at(std::span<const Pixel> run, std::span<const double> x, std::span<const double> y,
                   std::span<const double> t, std::span<std::uint8_t> inside) const noexcept {
    const std::size_t n = x.size() / run.size();
    const Vec2 reach{1 + std::fabs(motion_.x), 1 + std::fabs(motion_.y)};
    std::fill(inside.begin(), inside.end(), std::uint8_t{0});
    for (std::size_t p = 0; p < run.size(); ++p) {
      mark_inside_at(circle_, motion_, run[p], x.subspan(p * n, n), y.subspan(p * n, n), t.subspan(p * n, n), reach,
                     inside.subspan(p * n, n));
    }
  }

  Cover cover(Pixel origin, Rect r) const noexcept { return moire::cover(circle_, motion_, origin, 0, r); }

  bool strips(Pixel origin, std::span<const double> sides, Strips out) const noexcept {
    moire::strips(circle_, origin, sides, out);
    return true;
  }

  void boundary(Pixel origin, double, Boundary& out) const {
    out.circles.push_back(boundary_circle(circle_, seen_from(circle_, origin, 0.5)));
  }

  StoredDoubles stored() const {
    StoredDoubles doubles{{"center", {circle_.center.x, circle_.center.y}}, {"radius", {circle_.radius}}};
    if (motion_ != Vec2{}) doubles.push_back({"motion", {motion_.x, motion_.y}});
    return doubles;
  }

  Vec2 motion() const noexcept { return motion_; }
  Vec2 sweep() const noexcept { return motion_; }

 private:
  GivenCircle circle_;
  Vec2 motion_;
};

}  // namespace

extern constinit const TestImageInfo disk_testimage;
constinit const TestImageInfo disk_testimage =
    describe<Disk>({.name = "disk",
                    .title = "Disk",
                    .cite = "Mitchell, \"Ray tracing and irregularities of distribution\", 1992, section 4",
                    .params = kParams});

}  // namespace moire
