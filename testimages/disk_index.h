// Which of many disjoint disks are near a rectangle, for any mix of radii and any clustering of centres.
//
// A k-d tree of the centres (Bentley, "Multidimensional binary search trees used for associative searching", CACM
// 18(9), 1975) that is a heap in the radii, as in McCreight, "Priority search trees", SIAM J. Computing 14(2), 1985:
// each node holds the largest disk of its subtree, the others are halved at the median of the longer side. Large disks
// so stay out of the boxes of small ones, and a search for disks above a size ends early. Built in O(n log n), of depth
// log2 n; disjoint disks of a size and more can not crowd around a small rectangle, so that a search visits few nodes
// beside those it reports. The tree depends on the set of disks alone, not on their order.
#pragma once

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "core/geometry.h"
#include "testimages/circle.h"

namespace moire {

// Whether the disk meets the closed rectangle, both in one frame; true as well for disks that miss it by a rounding.
inline bool near(const GivenCircle& c, const Rect& r) noexcept {
  // Clamping is exact, and rounded differences grow with the true ones.
  const double dx = c.center.x - std::clamp(c.center.x, r.lo.x, r.hi.x);
  const double dy = c.center.y - std::clamp(c.center.y, r.lo.y, r.hi.y);
  return dx * dx + dy * dy <= c.radius * c.radius * (1 + 0x1p-49);
}

// The smallest rectangles of doubles that are sure to hold a disk; and one given relative to the corner of a pixel.
Rect bounding_box(const GivenCircle& c) noexcept;
Rect absolute(Pixel origin, const Rect& r) noexcept;

class DiskIndex {
 public:
  struct Entry {
    GivenCircle circle;
    std::size_t number = 0;  // in the list that was given
    Rect box;                // holds the disks of the subtree
  };

  explicit DiskIndex(std::span<const GivenCircle> disks);

  // In the tree's order: the root of a subtree, its left half, its right half.
  std::span<const Entry> entries() const noexcept { return entries_; }

  // Calls f(entry) for every disk near the rectangle, large ones first within a subtree, until f returns false. Returns
  // whether f never did.
  template <class F>
  bool visit(const Rect& r, F&& f) const {
    return walk([](const Entry&) { return true; }, r, f);
  }

  // Numbers of two disks that overlap, none when all are disjoint. Which two does not depend on the machine. O(n log
  // n), also for lists that are not disjoint: the search ends at the first pair.
  struct Pair {
    std::size_t first = 0, second = 0;  // first < second
  };
  std::optional<Pair> find_overlap() const;

 private:
  void build(std::size_t begin, std::size_t end);

  // Where a subtree's right half begins; the left one begins after the root.
  static std::size_t middle(std::size_t begin, std::size_t end) { return begin + 1 + (end - begin - 1) / 2; }

  // visit() within the subtrees whose root passes `enter`.
  template <class Enter, class F>
  bool walk(Enter&& enter, const Rect& r, F&& f) const {
    struct Range {
      std::size_t begin, end;
    };
    // Each step takes one range and leaves at most two, the second half the size: one more than the depth.
    std::array<Range, 66> waiting;
    std::size_t count = 0;
    if (!entries_.empty()) waiting[count++] = {0, entries_.size()};
    while (count > 0) {
      const Range at = waiting[--count];
      const Entry& e = entries_[at.begin];
      const bool apart = e.box.hi.x < r.lo.x || r.hi.x < e.box.lo.x || e.box.hi.y < r.lo.y || r.hi.y < e.box.lo.y;
      if (apart || !enter(e)) continue;
      if (near(e.circle, r) && !f(e)) return false;
      const std::size_t mid = middle(at.begin, at.end);
      assert(count + 2 <= waiting.size());
      if (mid < at.end) waiting[count++] = {mid, at.end};
      if (at.begin + 1 < mid) waiting[count++] = {at.begin + 1, mid};
    }
    return true;
  }

  std::vector<Entry> entries_;
};

}  // namespace moire
