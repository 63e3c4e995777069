// A radial kernel seen from the side: what an edge, or any image that varies along one axis alone, is filtered with.
//
// P(x) = integral of k(sqrt(x^2 + y^2)) over y, even, of integral 1, the same from every direction (R. Bracewell, "The
// Fourier Transform and Its Applications", 1965: the Abel transform). At a knot P ends as a half-odd power of the
// distance to it; at x = 0 it has a logarithm where odd powers of r are in k.
#pragma once

#include "filters/radial_kernel.h"

namespace moire {

// A view: the kernel must outlive it. Errors of P() and beyond(): rounding, some 1e-15 of their integrals of absolute
// values, besides the kernel's own. x in pixels from the centre, above 0.
class RadialProjection {
 public:
  explicit RadialProjection(const RadialKernel& kernel) : kernel_(kernel) {}

  double P(double x) const;
  // Integral of P from x to the radius: the value of a pixel whose centre lies x pixels outside a half-plane.
  double beyond(double x) const;
  // Integral of beyond (1 - beyond) over all x, in pixels: how far a filtered step is from the step.
  double spread() const;
  // Largest value of -beyond, or 0: the overshoot of a step of height 1, either way. Its places are zeros of P,
  // bracketed by 32 samples to a piece and bisected; two of them closer than that enclose nothing that could be seen.
  double overshoot() const;

 private:
  template <class F>
  double over_rays(double x, const F& f) const;

  const RadialKernel& kernel_;
};

}  // namespace moire
