// The union of disjoint disks as a scene.
#include "testimages/disk_union.h"

#include <algorithm>
#include <cmath>

namespace moire {
namespace {

// Where a pixel has more disks than this, each of its points asks the index: measured with 256 points, 130 ns a point
// whatever their number, against 1.2 ns a point and disk.
constexpr int kTogether = 32;

}  // namespace

void DiskUnion::contains(std::span<const Pixel> run, std::span<const double> x, std::span<const double> y,
                         std::span<std::uint8_t> inside) const noexcept {
  const std::size_t n = x.size() / run.size();
  std::fill(inside.begin(), inside.end(), std::uint8_t{0});
  for (std::size_t p = 0; p < run.size(); ++p) {
    const auto px = x.subspan(p * n, n), py = y.subspan(p * n, n);
    const auto marked = inside.subspan(p * n, n);
    if (mark_disks(run[p], px, py, kTogether, marked)) continue;
    for (std::size_t i = 0; i < n; ++i) {
      // Marks of the attempt above stay: they are right.
      mark_disks(run[p], px.subspan(i, 1), py.subspan(i, 1), index_.entries().size(), marked.subspan(i, 1));
    }
  }
}

// One disk decides all: a rectangle inside one meets no other.
Cover DiskUnion::cover(Pixel origin, Rect r) const noexcept {
  Cover found = Cover::none;
  index_.visit(absolute(origin, r), [&](const DiskIndex::Entry& e) {
    found = moire::cover(seen_from(e.circle, origin, 0), r);
    return found == Cover::none;
  });
  return found;
}

void DiskUnion::boundary(Pixel origin, double half_width, Boundary& out) const {
  const Rect window{{-half_width, -half_width}, {half_width, half_width}};
  const Rect from_corner{{0.5 - half_width, 0.5 - half_width}, {0.5 + half_width, 0.5 + half_width}};
  index_.visit(absolute(origin, from_corner), [&](const DiskIndex::Entry& e) {
    const LocalCircle at = seen_from(e.circle, origin, 0.5);
    if (moire::cover(at, window) != Cover::none) out.circles.push_back(boundary_circle(e.circle, at));
    return true;
  });
}

bool DiskUnion::mark_disks(Pixel origin, std::span<const double> x, std::span<const double> y, std::size_t most,
                           std::span<std::uint8_t> inside) const noexcept {
  const auto [left, right] = std::minmax_element(x.begin(), x.end());
  const auto [top, bottom] = std::minmax_element(y.begin(), y.end());
  const Rect box{{*left, *top}, {*right, *bottom}};
  const Vec2 reach{std::max(std::fabs(box.lo.x), std::fabs(box.hi.x)),
                   std::max(std::fabs(box.lo.y), std::fabs(box.hi.y))};
  return index_.visit(absolute(origin, box), [&](const DiskIndex::Entry& e) {
    if (most-- == 0) return false;
    mark_inside(e.circle, origin, x, y, reach, inside);
    return true;
  });
}

}  // namespace moire
