// The time average of a moving set's filtered value: Green's form of boundary_integral.h with one integral more,
//   integral over time of (closed integral of K(x) k(y) dy over the moved boundary)
//   = closed integral over the boundary of J(p) dy, J(p) = mean over time of K(x) k(y) on the path from p,
// the boundary being that of time 0. K vanishes left of the support; right of it K = 1, so that a piece counts by the
// mean of K(y) at its two ends. J is analytic along the boundary but where the path's first or last point crosses a
// knot's line or the path passes a corner of the knots' grid: there the boundary is cut, and between cuts
// Gauss-Legendre quadrature has a proven remainder (Bernstein ellipses). At the cuts J is continuous, unless the motion
// is along an axis.
#pragma once

#include <vector>

#include "core/geometry.h"
#include "core/sum.h"
#include "curve/boundary.h"
#include "engine/swept_path.h"
#include "engine/swept_track.h"
#include "filters/kernel.h"

namespace moire {

class SweptIntegral {
 public:
  // Corners of the knots' grid, and so the time per pixel, grow with the square of the number of pieces.
  static constexpr int kMaxPieces = 64;

  // `motion`, pixels, not (0, 0), each component up to an ulp of the true one. Components that are nothing beside
  // rounding, below some 10^-13 of the motion and the kernel, are left out and count for the bound.
  // Precondition: kernel.pieces() <= kMaxPieces.
  SweptIntegral(const Kernel& kernel, Vec2 motion);

  // Whether a component of motion is left.
  bool moves() const { return path_.motion() != Vec2{}; }

  // Sets the sum and its bound to zero.
  void reset();
  // Precondition: moves().
  void add(const Segment& segment);
  void add(const Circle& circle);

  double value() const { return sum_.value(); }
  // Guaranteed bound on |value() - true average|: rounding, quadrature, kernel fit, doubts of segments.
  double bound() const;
  // What leaving out components of the motion may change.
  double motion_error() const { return motion_error_; }

 private:
  // How far a piece may reach beyond a line on whose other side it is said to be, and bounds of K and k on paths that
  // are continued beyond their ends for as long as that takes.
  struct Margin {
    double thick, k_top, K_top;
  };
  Margin margin(double thick) const;

  template <class Track>
  void add_track(const Track& track, double miss);
  template <class Track>
  void add_piece(const Track& track, double from, double to, int depth);
  template <class Track>
  void add_right(const Track& track, double from, double to, const Rect& extent, const Margin& m);
  // The share of the time that a path can be in the support.
  double seen() const;
  bool near_line(Vec2 p, double distance) const;
  void add_wrong_sides(const Rect& extent, double travel, bool straight, const Margin& m);

  const Kernel& kernel_;
  double motion_error_ = 0;
  SweptPath path_;
  SweptGrid grid_;
  double reach_, shortest_;  // SweptGrid::reach(); half length of the shortest piece
  std::vector<double> cuts_;
  std::vector<SweptPath::Stretch> stretches_;
  double miss_ = 0;       // how far from its line a cut of the curve being added is
  Margin plain_, close_;  // of its pieces; close_: of those whose side of some line is uncertain

  Sum sum_;
  double error_ = 0;
};

}  // namespace moire
