// One boundary integral for every radial filter: the integral of k(r) over a plane set equals the closed integral of
// q(r) (x dy - y dx) over its boundary (Green), q(r) = G(r) / r^2 and G(r) the integral of k(s) s ds from 0 to r.
//
// Since x dy - y dx = r^2 dphi, that is the integral of G over the polar angle phi: pieces beyond the radius contribute
// G(radius) times the angle that they turn, in closed form, so that the curves need no clipping. Inside, pieces are cut
// at the kernel's knots and integrated by Gauss-Legendre quadrature with a proven remainder. q is continuous at the
// knots: where exactly a piece is cut does not matter.
#pragma once

#include "core/sum.h"
#include "curve/boundary.h"
#include "engine/radial_offset.h"
#include "engine/radial_track.h"
#include "filters/radial_kernel.h"

namespace moire {

class RadialIntegral {
 public:
  explicit RadialIntegral(const RadialKernel& kernel) : kernel_(kernel), offset_(kernel) {}

  // Sets the sum and its bound to zero.
  void reset();
  void add(const Segment& segment);
  void add(const Circle& circle);

  double value() const { return sum_.value(); }
  // Guaranteed bound on |value() - integral over the true curves|: rounding, quadrature, kernel fit and the doubts of
  // the segments.
  double bound() const;

 private:
  // What is integrated along a track: q, or on a tiny circle its difference from the circle's centre.
  struct Along {
    const RadialTrack& track;
    double weight;
    double target;  // what each piece's quadrature may miss, or be left out for
    double off;     // u by which r of a node may err, relative
    bool tiny;
  };

  void add_angle(double weight, double cross, double dot, double near_rim);
  void add_halves(const Circle& circle, double distance);
  void add_tiny(const Circle& circle, Dd distance);
  void add_track(const Along& along, double from, double to);
  void add_pieces(const Along& along, double from, double to);
  void add_piece(const Along& along, double from, double to, int depth);
  double bound_in_disk(const Along& along, int piece, double r, double reach) const;

  const RadialKernel& kernel_;
  RadialOffset offset_;  // of the tiny circle being added
  Sum sum_;
  double error_ = 0;
};

}  // namespace moire
