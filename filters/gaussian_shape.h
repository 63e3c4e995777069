// The bell exp(-x^2 / 2 sigma^2), cut at a radius: the shape of the separable and of the radial Gaussian filter.
#pragma once

#include <algorithm>
#include <cmath>

#include "core/dd_math.h"

namespace moire {

struct GaussianShape {
  double sigma, radius;
  bool offset;  // lowered so that it ends at zero

  // Pieces of at most 3/2 sigma, where degree 17 reaches rounding.
  int pieces_to_a_side() const { return static_cast<int>(std::ceil(radius / (1.5 * sigma))); }
  int degree() const { return -1; }

  Dd shape(int, Dd x) const {
    const Dd scale = Dd(-0.5) / (Dd(sigma) * Dd(sigma));
    const Dd value = dd_exp(scale * x * x);
    return offset ? value - dd_exp(scale * Dd(radius) * Dd(radius)) : value;
  }

  // |exp(w)| = exp(Re w), and |exp(w) - exp(v)| <= |w - v| exp(max(Re w, Re v)): the second is what a wide Gaussian
  // needs whose offset leaves little.
  double ellipse_bound(int, double rho) const {
    const double half = std::min(radius, 0.75 * sigma);
    const double height = half * (rho - 1 / rho) / 2;          // imaginary semi-axis
    const double reach = radius + half * (rho + 1 / rho) / 2;  // |z| stays below
    const double largest = std::exp(height * height / (2 * sigma * sigma));
    if (!offset) return largest;
    return std::min(largest + 1, (radius * radius + reach * reach) / (2 * sigma * sigma) * largest);
  }
};

}  // namespace moire
