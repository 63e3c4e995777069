// The union of disjoint disks as a scene: what the kinds `disks` and `noise-field` share.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "core/geometry.h"
#include "curve/boundary.h"
#include "testimages/circle.h"
#include "testimages/disk_index.h"
#include "testimages/testimage.h"

namespace moire {

// Answers as TestImageType (testimage.h) asks. The disks must be disjoint: they may touch, and a point of two disks is
// inside once.
class DiskUnion {
 public:
  explicit DiskUnion(std::span<const GivenCircle> disks) : index_(disks) {}
  const DiskIndex& index() const noexcept { return index_; }

  void contains(std::span<const Pixel> run, std::span<const double> x, std::span<const double> y,
                std::span<std::uint8_t> inside) const noexcept;
  Cover cover(Pixel origin, Rect r) const noexcept;
  void boundary(Pixel origin, double half_width, Boundary& out) const;

 private:
  // Marks the points of one pixel that are in a disk, unless more than `most` disks are near: then false, with some
  // marked.
  bool mark_disks(Pixel origin, std::span<const double> x, std::span<const double> y, std::size_t most,
                  std::span<std::uint8_t> inside) const noexcept;

  DiskIndex index_;
};

}  // namespace moire
