// q as a tiny circle sees it: its difference from q at the circle's centre, which shrinks with the circle, and so do
// its errors, where q itself has a floor.
#pragma once

#include <cstddef>
#include <vector>

#include "core/double_double.h"
#include "engine/radial_track.h"
#include "filters/radial_kernel.h"

namespace moire {

// r^2 q(r) - D^2 q(D) is the integral of k(s) s ds from D to r; less 2 q(D) s it is r^2 (q(r) - q(D)).
class RadialOffset {
 public:
  explicit RadialOffset(const RadialKernel& kernel) : kernel_(kernel) {}

  // The circle's centre is at the distance D > radius.
  void place(Dd distance, double radius);

  double q_there() const { return q_; }  // q(D)
  // Of a point of the circle, r - D; right to 12 u of the radius, and to what the chord errs by.
  double along(const RadialTrack& track, double chord) const;
  std::size_t knots() const { return at_.size(); }                 // of the kernel within the circle's reach
  double chord(const RadialTrack& track, std::size_t knot) const;  // where one of them is passed; 0 where nowhere
  int piece_of(double offset) const;       // that D + offset lies in; pieces() beyond the radius
  double difference(double offset) const;  // q(D + offset) - q(D), |offset| <= radius
  // Bound on the difference in the complex plane, in the disk of radius `reach` around D + offset.
  double difference_in_disk(int piece, double offset, double reach) const;

  // Bounds for all offsets up to the radius: on the difference, and on its error where an offset errs by 40 u of the
  // radius.
  double top() const { return top_; }
  double error() const { return error_; }

 private:
  double integral(double offset) const;
  double over(int piece, double from, double to) const;

  const RadialKernel& kernel_;
  double distance_ = 0, rest_ = 0, q_ = 0, radius_ = 0, top_ = 0, error_ = 0;
  int home_ = 0, first_ = 0;  // the pieces that hold D and D - radius
  std::vector<double> at_;    // knots within reach, counted from D
};

}  // namespace moire
