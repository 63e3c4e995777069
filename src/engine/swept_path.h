// What a point sees that moves along a straight line while the shutter is open: the mean over time of K(x) k(y), K the
// antiderivative of a kernel k. The path is cut where it crosses the kernel's knots; between cuts the integrand is one
// polynomial, which Gauss-Legendre quadrature gets to rounding.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/geometry.h"
#include "filters/kernel.h"

namespace moire {

class SweptPath {
 public:
  // `motion`, pixels: from time 0 to time 1.
  SweptPath(const Kernel& kernel, Vec2 motion);

  Vec2 motion() const { return motion_; }

  // What ends a stretch of path: the first or last time, or a knot of x or y.
  enum class Cut : std::uint8_t { time, x_knot, y_knot };
  // From time t0 to t1 inside one knot cell: piece px in x, py in y (-1 and kernel.pieces(): outside the support).
  struct Stretch {
    double t0, t1;
    int px, py;
    Cut first, last;
    // Whether K(x) k(y) is not 0 there, and whether K = 1.
    bool counts(int pieces) const { return px >= 0 && py >= 0 && py < pieces; }
  };
  // The stretches of the path that begins at p, in order; what `out` held is replaced.
  void split(Vec2 p, std::vector<Stretch>& out) const;

  // A mean, the same with bounds for K and k, and a bound on its error.
  struct Mean {
    double value = 0, top = 0, error = 0;
  };
  // How far what is known of a path may be from the truth, pixels: `off` is the distance of computed points of the path
  // from the true ones, rounding of times included; within `thick` of a knot of y the path's first and last point may
  // be on the wrong side of it, which counts with `K_top` for K.
  struct Doubt {
    double off, thick, K_top;
  };
  // Of K(x) k(y) on the path that begins at p. Where motion().y is 0, all of it is in piece py of y, as if p were.
  Mean mean(Vec2 p, int py, const Doubt& doubt) const;
  // Of K(y) on the path that begins at y.
  Mean mean_K(double y, double off) const;

  // A bound on |mean| of K(x) k(y), continued analytically with these stretches, for all complex points whose
  // coordinates are within reach.x and reach.y of the p that was split.
  double top(std::span<const Stretch> stretches, Vec2 reach) const;

  // A bound on the jump of k at a knot.
  double jump(int knot) const;

 private:
  struct Walker;
  Walker walker(double from, double d) const;
  void advance(Walker& w) const;
  template <class F>
  void walk(Vec2 p, F&& f) const;
  void add_near_knots(double y, const Doubt& doubt, Mean& mean) const;

  const Kernel& kernel_;
  Vec2 motion_;
  int nodes_;         // per stretch, with a remainder for K k and for K
  double remainder_;  // per unit of time
};

}  // namespace moire
