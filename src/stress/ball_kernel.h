// The reconstruction kernels enclosed: their published formulas in ball arithmetic (F. Johansson, "Arb: efficient
// arbitrary-precision midpoint-radius interval arithmetic", IEEE Trans. Computers 66(8), 2017), and their integrals by
// adaptive Gauss-Legendre rules with rigorous bounds (F. Johansson, "Numerical integration in arbitrary-precision ball
// arithmetic", ICMS 2018). No antiderivatives, no Chebyshev series.
#pragma once

#include <memory>

#include "filters/filter.h"
#include "oracle/quad.h"

namespace moire::stress {

// The truth is within `error` of `value`.
struct Enclosed {
  oracle::Quad value = 0;
  double error = 0;
};

// A filter's kernel, over the integral of the same formula.
class BallKernel {
 public:
  // Throws std::invalid_argument for filters without a formula, such as tables.
  explicit BallKernel(const Filter& filter);
  ~BallKernel();
  BallKernel(const BallKernel&) = delete;
  BallKernel& operator=(const BallKernel&) = delete;

  // Where the kernel ends, pixels.
  double radius() const;
  // Of a separable kernel: k(x), half-open as the program's, and its integral up to x.
  Enclosed k(double x) const;
  Enclosed K(double x) const;
  // Of a radial kernel: k(r), G(r) = integral of k(s) s ds from 0 to r, q(r) = G(r) / r^2; r >= 0.
  Enclosed radial_k(double r) const { return k(r); }
  Enclosed G(double r) const;
  Enclosed q(double r) const;
  // k(x) by the formula in plain double arithmetic, over the true integral.
  double naive_k(double x) const;

 private:
  struct Data;
  std::unique_ptr<Data> data_;
};

}  // namespace moire::stress
