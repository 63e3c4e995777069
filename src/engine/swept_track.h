// Boundary curves of a moving set as one parameter runs along them, where to cut them, and what is known of a piece:
// quarters of circles and segments alike, for the integral over a swept boundary (swept_integral.h).
#pragma once

#include <optional>
#include <vector>

#include "core/geometry.h"
#include "curve/arc.h"
#include "curve/boundary.h"
#include "filters/kernel.h"

namespace moire {

// A point of a curve with dy per unit of its parameter; and a disk (of half widths `reach`) around it.
struct TrackPoint {
  Vec2 at;
  double rise;
};
struct TrackDisk {
  Vec2 reach;
  double rise;  // largest |dy| per unit of the parameter
};

// The lines that matter: K k changes its formula where the first or last point of a path is on a knot, or where a path
// meets a corner of the knots' grid.
struct SweptGrid {
  const Kernel& kernel;
  Vec2 motion;
  // Window of first points that can see the support, right of which K = 1 all the time.
  Rect window() const;
  // The larger component of the motion, and the largest coordinate in the window.
  double travel() const;
  double reach() const;
};

// A quarter of a circle. Parameters as in curve/arc.h.
class ArcTrack {
 public:
  explicit ArcTrack(const Arc& arc) : arc_(arc) {}

  // Sorted parameters where the quarter is to be cut, its ends (as far as they matter) among them; none: nothing
  // counts. Off the lines that they are on by less than miss().
  void cut(const SweptGrid& grid, std::vector<double>& cuts) const;
  static double miss(const SweptGrid& grid, const Arc& arc);
  double y(double v) const { return arc_.upright ? arc_.run(v) : arc_.other(v); }
  // +1 where the walk around the set follows the parameter, -1 where it goes against it.
  double direction() const { return arc_.upright ? arc_.side : -arc_.side; }
  int degree(const Kernel&) const { return -1; }
  // How far computed points of paths may be from true ones on a piece of that half length; pixels.
  double off(const SweptGrid& grid, double half) const;

  class Piece {
   public:
    Piece(const ArcTrack& track, double from, double to);
    TrackPoint at(double tau) const;
    // The points of parameter within `reach` of the middle, also complex ones; none where the circle is not analytic.
    std::optional<TrackDisk> disk(double reach) const;
    // A rectangle that holds the piece, up to rounding.
    Rect extent() const;

   private:
    const Arc& arc_;
    double half_;
    ArcMiddle middle_;
  };

 private:
  void cut_corner(const SweptGrid& grid, Vec2 corner, std::vector<double>& cuts) const;

  const Arc& arc_;
};

// A segment, from 0 to 1.
class SegmentTrack {
 public:
  explicit SegmentTrack(const Segment& segment) : segment_(segment) {}

  void cut(const SweptGrid& grid, std::vector<double>& cuts) const;
  static double miss(const SweptGrid& grid, const Segment& segment);
  double y(double v) const { return place(v).y; }
  double direction() const { return segment_.weight; }
  // Of the integrand between cuts.
  int degree(const Kernel& kernel) const { return 2 * kernel.degree() + 2; }
  // How far computed points of paths may be from true ones on a piece of that half length; pixels.
  double off(const SweptGrid& grid, double half) const;

  class Piece {
   public:
    Piece(const SegmentTrack& track, double from, double to)
        : track_(track), middle_(0.5 * (from + to)), half_(0.5 * (to - from)) {}
    TrackPoint at(double tau) const;
    std::optional<TrackDisk> disk(double reach) const;
    Rect extent() const;

   private:
    const SegmentTrack& track_;
    double middle_, half_;
  };

 private:
  Vec2 place(double v) const;

  const Segment& segment_;
};

}  // namespace moire
