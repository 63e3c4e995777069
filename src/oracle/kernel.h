// The reconstruction kernels once more, from their published formulas, in long double; no antiderivative anywhere.
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "oracle/quadrature.h"
#include "oracle/shapes.h"

namespace moire::oracle {

// A symmetric 1-D kernel k on [-radius, radius], normalised to integral 1 by quadrature of itself. x in pixels.
class Kernel {
 public:
  // "name" or "name:key=value,..." with the names and defaults of the program.
  explicit Kernel(std::string_view text);
  // A kernel of the caller's own.
  explicit Kernel(const HalfKernel& half);

  long double radius() const { return knots_.back(); }
  // Where k is not analytic, its ends included; long smooth pieces are cut further, so that the rules below suffice.
  std::span<const long double> knots() const { return knots_; }
  // k within the support; at a knot, the value of the outer piece.
  long double operator()(long double x) const { return value(x < 0 ? -x : x) * scale_; }
  // Integral of k over [a, b] within the support, by Gauss-Legendre between knots. Zero where a >= b.
  long double over(long double a, long double b) const;
  // Integral of |k|, to judge rounding.
  long double gain() const { return gain_; }
  // Rules for the integrals across lines; exact for polynomial kernels.
  const RulePair& line_rules() const { return line_rules_; }
  // max over x of |sum over integers j of k(x + j) - 1|: zero for a partition of unity.
  long double ripple() const;

 private:
  long double value(long double x) const;  // not yet scaled; x >= 0
  void tabulate();
  long double absolute() const;

  HalfKernel half_;                          // its breaks are those of knots_ that are not negative
  std::vector<long double> nodes_, newton_;  // polynomials: degree + 1 nodes in [-1, 1]; Newton's form piece by piece
  std::vector<long double> knots_, mass_;
  long double scale_ = 1, gain_ = 1;
  Rule inner_;
  RulePair line_rules_;
};

}  // namespace moire::oracle
