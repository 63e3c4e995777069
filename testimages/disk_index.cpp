// Building the index of disks, and the search for overlaps; see disk_index.h.
#include "testimages/disk_index.h"

#include <iterator>
#include <limits>
#include <tuple>

#include "core/double_double.h"

namespace moire {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

double below(double v) { return std::nextafter(v, -kInfinity); }
double above(double v) { return std::nextafter(v, kInfinity); }

// Larger disks first. A total order of disjoint disks that does not ask where they stand in the list.
bool ahead(const DiskIndex::Entry& a, const DiskIndex::Entry& b) {
  const auto key = [](const DiskIndex::Entry& e) {
    return std::tuple(-e.circle.radius, e.circle.center.x, e.circle.center.y, e.number);
  };
  return key(a) < key(b);
}

Rect unite(const Rect& a, const Rect& b) {
  return {{std::min(a.lo.x, b.lo.x), std::min(a.lo.y, b.lo.y)}, {std::max(a.hi.x, b.hi.x), std::max(a.hi.y, b.hi.y)}};
}

}  // namespace

Rect bounding_box(const GivenCircle& c) noexcept {
  return {{below(c.center.x - c.radius), below(c.center.y - c.radius)},
          {above(c.center.x + c.radius), above(c.center.y + c.radius)}};
}

Rect absolute(Pixel origin, const Rect& r) noexcept {
  const Dd x = dd_from_integer(origin.x), y = dd_from_integer(origin.y);
  return {{below((x + Dd(r.lo.x)).value()), below((y + Dd(r.lo.y)).value())},
          {above((x + Dd(r.hi.x)).value()), above((y + Dd(r.hi.y)).value())}};
}

DiskIndex::DiskIndex(std::span<const GivenCircle> disks) {
  entries_.reserve(disks.size());
  for (std::size_t i = 0; i < disks.size(); ++i) entries_.push_back({disks[i], i, bounding_box(disks[i])});
  if (!entries_.empty()) build(0, entries_.size());
}

void DiskIndex::build(std::size_t begin, std::size_t end) {
  const auto at = [&](std::size_t i) { return entries_.begin() + static_cast<std::ptrdiff_t>(i); };
  std::iter_swap(at(begin), std::min_element(at(begin), at(end), ahead));
  if (end - begin == 1) return;
  Rect centers{{kInfinity, kInfinity}, {-kInfinity, -kInfinity}};
  for (std::size_t i = begin + 1; i < end; ++i) {
    centers = unite(centers, {entries_[i].circle.center, entries_[i].circle.center});
  }
  const std::size_t mid = middle(begin, end);
  const auto split = [&](auto coordinate) {
    // Ties broken, the halves are the same sets however the library selects.
    std::nth_element(at(begin + 1), at(mid), at(end), [&](const Entry& a, const Entry& b) {
      const double p = coordinate(a.circle.center), q = coordinate(b.circle.center);
      return p != q ? p < q : ahead(a, b);
    });
  };
  if (centers.hi.x - centers.lo.x >= centers.hi.y - centers.lo.y) {
    split([](Vec2 p) { return p.x; });
  } else {
    split([](Vec2 p) { return p.y; });
  }
  for (const auto& [from, to] : {std::pair{begin + 1, mid}, std::pair{mid, end}}) {
    if (from == to) continue;
    build(from, to);
    entries_[begin].box = unite(entries_[begin].box, entries_[from].box);
  }
}

std::optional<DiskIndex::Pair> DiskIndex::find_overlap() const {
  std::vector<const Entry*> order;
  order.reserve(entries_.size());
  for (const Entry& e : entries_) order.push_back(&e);
  // Each disk against those ahead of it. Octave by octave of the radius, so that the disks found disjoint so far leave
  // room for few near any other; the tree's order within an octave stays in the cache.
  std::stable_sort(order.begin(), order.end(), [](const Entry* a, const Entry* b) {
    return std::ilogb(a->circle.radius) > std::ilogb(b->circle.radius);
  });
  for (const Entry* e : order) {
    std::size_t other = entries_.size();
    walk([&](const Entry& o) { return ahead(o, *e); }, bounding_box(e->circle),
         [&](const Entry& o) {
           if (overlap(o.circle, e->circle)) other = std::min(other, o.number);
           return true;
         });
    if (other < entries_.size()) return Pair{std::min(other, e->number), std::max(other, e->number)};
  }
  return std::nullopt;
}

}  // namespace moire
