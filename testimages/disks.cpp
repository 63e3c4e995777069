// Disjoint disks, up to millions and of any sizes: curved edges in all directions at once, detail from far below the
// pixel to far above it. Disks may touch; a point of two disks is inside once.
#include <fmt/format.h>

#include <cmath>
#include <string>
#include <vector>

#include "core/double_double.h"
#include "core/error.h"
#include "testimages/circle.h"
#include "testimages/disk_union.h"
#include "testimages/scene_args.h"
#include "testimages/testimage.h"

namespace moire {
namespace {

constexpr Param kParams[] = {
    numbers("disks", true, "", "a list of at least one [x, y, radius], in pixels; disks may touch but not overlap"),
    motion_param()};

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
  Disks(const Args& args, Grid) : Disks(*args.find("disks"), moire::motion(args)) {}

  void contains(std::span<const Pixel> run, std::span<const double> x, std::span<const double> y,
                std::span<std::uint8_t> inside) const noexcept {
    disks_.contains(run, x, y, inside);
  }
  void contains_at(std::span<const Pixel> run, std::span<const double> x, std::span<const double> y,
                   std::span<const double> t, std::span<std::uint8_t> inside) const noexcept {
    disks_.contains_at(run, x, y, t, inside);
  }
  Cover cover(Pixel origin, Rect r) const noexcept { return disks_.cover(origin, r); }
  bool strips(Pixel origin, std::span<const double> sides, Strips out) const noexcept {
    return disks_.strips(origin, sides, out);
  }
  void boundary(Pixel origin, double half_width, Boundary& out) const { disks_.boundary(origin, half_width, out); }

  // In the order of the list, row by row.
  StoredDoubles stored() const {
    std::vector<double> rows(3 * disks_.index().entries().size());
    for (const DiskIndex::Entry& e : disks_.index().entries()) {
      rows[3 * e.number] = e.circle.center.x;
      rows[3 * e.number + 1] = e.circle.center.y;
      rows[3 * e.number + 2] = e.circle.radius;
    }
    StoredDoubles doubles{{"disks", rows}};
    if (const Vec2 m = motion(); m != Vec2{}) doubles.push_back({"motion", {m.x, m.y}});
    return doubles;
  }

  Vec2 motion() const noexcept { return disks_.motion(); }
  Vec2 sweep() const noexcept { return disks_.motion(); }

 private:
  Disks(const Value& v, Vec2 motion) : Disks(v, read(v), motion) {}
  Disks(const Value& v, const std::vector<GivenCircle>& disks, Vec2 motion) : disks_(disks, motion) {
    refuse_overlap(v, disks, disks_.index());
  }

  DiskUnion disks_;
};

}  // namespace

extern constinit const TestImageInfo disks_testimage;
constinit const TestImageInfo disks_testimage =
    describe<Disks>({.name = "disks",
                     .title = "Disjoint disks",
                     .cite = "Mitchell, \"Ray tracing and irregularities of distribution\", 1992, section 4",
                     .params = kParams});

}  // namespace moire
