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
// inside once. All move together, by `motion`, as Moves asks.
class DiskUnion {
 public:
  explicit DiskUnion(std::span<const GivenCircle> disks, Vec2 motion = {}) : index_(disks), motion_(motion) {}
  const DiskIndex& index() const noexcept { return index_; }

  void contains(std::span<const Pixel> run, std::span<const double> x, std::span<const double> y,
                std::span<std::uint8_t> inside) const noexcept;
  void contains_at(std::span<const Pixel> run, std::span<const double> x, std::span<const double> y,
                   std::span<const double> t, std::span<std::uint8_t> inside) const noexcept;
  Cover cover(Pixel origin, Rect r) const noexcept;
  void boundary(Pixel origin, double half_width, Boundary& out) const;
  // Where at most one disk is near the pixel.
  bool strips(Pixel origin, std::span<const double> sides, Strips out) const noexcept;
  Vec2 motion() const noexcept { return motion_; }

 private:
  // Points of one pixel; their times, or none of them where all is as at time 0.
  struct PixelPoints {
    std::span<const double> x, y, t;
  };
  // Marks the points that are in a disk, unless more than `most` disks are near: then false, with some marked.
  bool mark_disks(Pixel origin, const PixelPoints& points, std::size_t most,
                  std::span<std::uint8_t> inside) const noexcept;
  void mark_all(std::span<const Pixel> run, const PixelPoints& points, std::span<std::uint8_t> inside) const noexcept;
  // Where a disk of time 0 is that meets the rectangle at some time.
  Rect reached(const Rect& r) const noexcept;

  DiskIndex index_;
  Vec2 motion_;
};

}  // namespace moire
