// Disjoint disks, up to millions and of any sizes: curved edges in all directions at once, detail from far below the
// pixel to far above it. Disks may touch; a point of two disks is inside once.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "core/double_double.h"
#include "core/error.h"
#include "testimages/circle.h"
#include "testimages/disk_index.h"
#include "testimages/scene_args.h"
#include "testimages/testimage.h"

namespace moire {
namespace {

constexpr Param kParams[] = {
    numbers("disks", true, "", "a list of at least one [x, y, radius], in pixels; disks may touch but not overlap")};

// Where a pixel has more disks than this, each of its points asks the index: measured with 256 points, 130 ns a point
// whatever their number, against 1.2 ns a point and disk.
constexpr int kTogether = 32;

std::string name_of(std::size_t i) { return "disks[" + std::to_string(i) + "]"; }

std::vector<GivenCircle> read(const Value& v) {
  if (v.rank == 1 && v.numbers.empty()) throw Error(v.place, "\"disks\" is empty; give at least one [x, y, radius]");
  if (v.rank != 2 || v.columns != 3) {
    throw Error(v.place, "\"disks\" must be a list of disks, [[x, y, radius], ...] in pixels");
  }
  std::vector<GivenCircle> disks;
  disks.reserve(v.numbers.size() / 3);
  for (std::size_t i = 0; i + 2 < v.numbers.size(); i += 3) {
    const GivenCircle c{{v.numbers[i], v.numbers[i + 1]}, v.numbers[i + 2]};
    const std::string name = name_of(disks.size());
    require_within(v, name, c.center.x);
    require_within(v, name, c.center.y);
    require_radius(v, "radius of " + name, c.radius);
    disks.push_back(c);
  }
  return disks;
}

void refuse_overlap(const Value& v, const std::vector<GivenCircle>& disks, const DiskIndex& index) {
  const auto pair = index.find_overlap();
  if (!pair) return;
  const GivenCircle &a = disks[pair->first], &b = disks[pair->second];
  const auto text = [](const GivenCircle& c) {
    return "[" + shortest(c.center.x) + ", " + shortest(c.center.y) + ", " + shortest(c.radius) + "]";
  };
  // (reach^2 - distance^2) / (reach + distance), which does not cancel where the disks hardly overlap.
  const Dd dx = two_sum(a.center.x, -b.center.x), dy = two_sum(a.center.y, -b.center.y),
           reach = two_sum(a.radius, b.radius);
  const double depth =
      (reach * reach - dx * dx - dy * dy).value() / (reach.hi + std::sqrt(dx.hi * dx.hi + dy.hi * dy.hi));
  throw Error(v.place,
              fmt::format("{} and {} (counted from 0) overlap by {:.3g} pixels: {} and {}; disks may touch, not more",
                          name_of(pair->first), name_of(pair->second), depth, text(a), text(b)));
}

class Disks {
 public:
  Disks(const Args& args, Grid) : Disks(*args.find("disks")) {}

  void contains(std::span<const Pixel> run, std::span<const double> x, std::span<const double> y,
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
  Cover cover(Pixel origin, Rect r) const noexcept {
    Cover found = Cover::none;
    index_.visit(absolute(origin, r), [&](const DiskIndex::Entry& e) {
      found = moire::cover(seen_from(e.circle, origin, 0), r);
      return found == Cover::none;
    });
    return found;
  }

  void boundary(Pixel origin, double half_width, Boundary& out) const {
    const Rect window{{-half_width, -half_width}, {half_width, half_width}};
    const Rect from_corner{{0.5 - half_width, 0.5 - half_width}, {0.5 + half_width, 0.5 + half_width}};
    index_.visit(absolute(origin, from_corner), [&](const DiskIndex::Entry& e) {
      const LocalCircle at = seen_from(e.circle, origin, 0.5);
      if (moire::cover(at, window) != Cover::none) out.circles.push_back(boundary_circle(e.circle, at));
      return true;
    });
  }

  // In the order of the list, row by row.
  StoredDoubles stored() const {
    std::vector<double> rows(3 * index_.entries().size());
    for (const DiskIndex::Entry& e : index_.entries()) {
      rows[3 * e.number] = e.circle.center.x;
      rows[3 * e.number + 1] = e.circle.center.y;
      rows[3 * e.number + 2] = e.circle.radius;
    }
    return {{"disks", rows}};
  }

 private:
  explicit Disks(const Value& v) : Disks(v, read(v)) {}
  Disks(const Value& v, const std::vector<GivenCircle>& disks) : index_(disks) { refuse_overlap(v, disks, index_); }

  // Marks the points of one pixel that are in a disk, unless more than `most` disks are near: then false, with some
  // marked.
  bool mark_disks(Pixel origin, std::span<const double> x, std::span<const double> y, std::size_t most,
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

  DiskIndex index_;
};

}  // namespace

extern constinit const TestImageInfo disks_testimage;
constinit const TestImageInfo disks_testimage =
    describe<Disks>({.name = "disks",
                     .title = "Disjoint disks",
                     .cite = "Mitchell, \"Ray tracing and irregularities of distribution\", 1992, section 4",
                     .params = kParams});

}  // namespace moire
