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
  mark_all(run, {x, y, {}}, inside);
}

void DiskUnion::contains_at(std::span<const Pixel> run, std::span<const double> x, std::span<const double> y,
                            std::span<const double> t, std::span<std::uint8_t> inside) const noexcept {
  mark_all(run, {x, y, t}, inside);
}

void DiskUnion::mark_all(std::span<const Pixel> run, const PixelPoints& points,
                         std::span<std::uint8_t> inside) const noexcept {
  const std::size_t n = points.x.size() / run.size();
  const auto some = [&](std::size_t begin, std::size_t count) {
    return PixelPoints{points.x.subspan(begin, count), points.y.subspan(begin, count),
                       points.t.empty() ? points.t : points.t.subspan(begin, count)};
  };
  std::fill(inside.begin(), inside.end(), std::uint8_t{0});
  for (std::size_t p = 0; p < run.size(); ++p) {
    if (mark_disks(run[p], some(p * n, n), kTogether, inside.subspan(p * n, n))) continue;
    for (std::size_t i = p * n; i < (p + 1) * n; ++i) {
      // Marks of the attempt above stay: they are right.
      mark_disks(run[p], some(i, 1), index_.entries().size(), inside.subspan(i, 1));
    }
  }
}

// A point moved back by its time, r of it; the padding is above all roundings.
Rect DiskUnion::reached(const Rect& r) const noexcept {
  if (motion_ == Vec2{}) return r;
  const auto pad = [](double v, double d) { return 0x1p-50 * (std::fabs(v) + std::fabs(d)); };
  const Vec2 lo{r.lo.x - std::max(motion_.x, 0.0), r.lo.y - std::max(motion_.y, 0.0)};
  const Vec2 hi{r.hi.x - std::min(motion_.x, 0.0), r.hi.y - std::min(motion_.y, 0.0)};
  return {{lo.x - pad(lo.x, motion_.x), lo.y - pad(lo.y, motion_.y)},
          {hi.x + pad(hi.x, motion_.x), hi.y + pad(hi.y, motion_.y)}};
}

// One disk decides all: a rectangle inside one meets no other.
Cover DiskUnion::cover(Pixel origin, Rect r) const noexcept {
  Cover found = Cover::none;
  index_.visit(absolute(origin, reached(r)), [&](const DiskIndex::Entry& e) {
    found = moire::cover(e.circle, motion_, origin, 0, r);
    return found == Cover::none;
  });
  return found;
}

bool DiskUnion::strips(Pixel origin, std::span<const double> sides, Strips out) const noexcept {
  const DiskIndex::Entry* only = nullptr;
  const bool known = index_.visit(absolute(origin, {{0, 0}, {1, 1}}), [&](const DiskIndex::Entry& e) {
    const bool first = only == nullptr;
    only = &e;
    return first;
  });
  if (!known) return false;
  if (only != nullptr) {
    moire::strips(only->circle, origin, sides, out);
  } else {
    for (const std::span<double> begin : {out.outer_begin, out.inner_begin}) std::fill(begin.begin(), begin.end(), 2);
    for (const std::span<double> end : {out.outer_end, out.inner_end}) std::fill(end.begin(), end.end(), -1);
  }
  return true;
}

void DiskUnion::boundary(Pixel origin, double half_width, Boundary& out) const {
  const Rect window{{-half_width, -half_width}, {half_width, half_width}};
  const Rect from_corner{{0.5 - half_width, 0.5 - half_width}, {0.5 + half_width, 0.5 + half_width}};
  index_.visit(absolute(origin, reached(from_corner)), [&](const DiskIndex::Entry& e) {
    if (moire::cover(e.circle, motion_, origin, 0.5, window) != Cover::none) {
      out.circles.push_back(boundary_circle(e.circle, seen_from(e.circle, origin, 0.5)));
    }
    return true;
  });
}

bool DiskUnion::mark_disks(Pixel origin, const PixelPoints& points, std::size_t most,
                           std::span<std::uint8_t> inside) const noexcept {
  const std::span<const double> x = points.x, y = points.y, t = points.t;  // clang 14 captures no bindings
  // Where the disks of time 0 hold these points: moved back.
  Rect box{{HUGE_VAL, HUGE_VAL}, {-HUGE_VAL, -HUGE_VAL}};
  const auto extend = [](double v, double& lo, double& hi) {
    lo = std::min(lo, v);
    hi = std::max(hi, v);
  };
  for (std::size_t i = 0; i < x.size(); ++i) {
    extend(t.empty() ? x[i] : x[i] - t[i] * motion_.x, box.lo.x, box.hi.x);
    extend(t.empty() ? y[i] : y[i] - t[i] * motion_.y, box.lo.y, box.hi.y);
  }
  Vec2 reach{std::max(std::fabs(box.lo.x), std::fabs(box.hi.x)), std::max(std::fabs(box.lo.y), std::fabs(box.hi.y))};
  if (!t.empty()) {
    reach = {reach.x + std::fabs(motion_.x), reach.y + std::fabs(motion_.y)};
    // Two roundings, of numbers below the reach.
    box = {{box.lo.x - 0x1p-50 * reach.x, box.lo.y - 0x1p-50 * reach.y},
           {box.hi.x + 0x1p-50 * reach.x, box.hi.y + 0x1p-50 * reach.y}};
  }
  return index_.visit(absolute(origin, box), [&](const DiskIndex::Entry& e) {
    if (most-- == 0) return false;
    if (t.empty()) {
      mark_inside(e.circle, origin, x, y, reach, inside);
    } else {
      mark_inside_at(e.circle, motion_, origin, x, y, t, reach, inside);
    }
    return true;
  });
}

}  // namespace moire
