// The part of a disk around the origin that lies between a board's horizon and some W, less a notch around the origin:
// where radial_series.h works.
#pragma once

#include <vector>

#include "core/geometry.h"
#include "testimages/homography.h"
#include "testimages/radial_rings.h"

namespace moire {

// 0 <= W <= depth, less what has W >= notch_depth and is no further than `notch`, pixels, from the line through the
// origin across lines of constant W. No notch: 0. Its corners are inside the disk; the part's sides pass the origin at
// clearance() or more.
struct RadialPart {
  double depth;
  double notch = 0, notch_depth = 0;

  static double clearance(double radius) { return kInnermost * radius; }
};

// In pixels; angles are counted from the way to larger W.
class DiskPart {
 public:
  // Between two angles, and between the same on the other side.
  struct Arc {
    double from, to;
  };

  DiskPart(const LocalHomography::Row& w, double radius, const RadialPart& part);

  double radius() const { return radius_; }
  double depth() const { return part_.depth; }
  // Whether a circle reaches the horizon.
  bool meets_horizon(double r) const { return centre_ < slope_ * r; }
  // Largest W on the disk of that radius inside the part.
  double largest_w(double r) const;
  Vec2 on_circle(double r, double angle) const;
  // Where a circle runs in the part; the last one ends on the horizon, if the circle reaches it.
  std::vector<Arc> arcs_of(double r) const;
  // Of a circle in the part, at most, rounding included, the notch not taken off.
  double length_of(double r) const;
  // From the one meet of the rim and W = depth to the other, around the notch, in the order that makes the closed
  // integral of x dy positive; empty: the disk ends before that.
  std::vector<Vec2> path() const;
  // The part's distance from the origin, at most; 0: it may hold it. That of the path.
  double distance() const;
  double path_distance() const;
  // Bound on the area of the part between two circles.
  double area(double low, double high) const;
  // How far from the origin the lines of W = 0 and W = depth are, at most: what their rounding depends on.
  double reach() const;

 private:
  double angle_at(double r, double w) const;

  RadialPart part_;
  double radius_, centre_, slope_, towards_;  // W at the origin, its slope and the angle of that
};

}  // namespace moire
