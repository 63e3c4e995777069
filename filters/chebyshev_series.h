// Chebyshev series on [-1, 1]: evaluation, and bounds on values, slopes and rounding errors.
//
// Trefethen, "Approximation Theory and Approximation Practice", 2013, chapters 3 and 8. A series is its coefficients
// c_0..c_n, never empty.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/double_double.h"

namespace moire {

// The sum of c[j] T_j(t), j <= degree, by Clenshaw's recurrence.
inline double chebyshev_sum(const double* c, int degree, double t) noexcept {
  double b1 = 0, b2 = 0;
  const double t2 = t + t;
  for (int j = degree; j >= 1; --j) {
    const double b = c[j] + (t2 * b1 - b2);
    b2 = b1;
    b1 = b;
  }
  return c[0] + (t * b1 - b2);
}

// The same bits for many t. Blocks of four, so that the compiler makes vectors of the inner loops and the recurrences
// of four points overlap.
void chebyshev_sums(const double* c, int degree, std::span<const double> t, double* out) noexcept;

// Sum of |c_j| rho^j: a bound on the series over the Bernstein ellipse of parameter rho, since |T_j| <= rho^j there.
double absolute_sum(std::span<const double> c, double rho) noexcept;

// Largest |value| for |t| <= 1 + beyond, and the rounding error of chebyshev_sum() there.
struct SeriesBound {
  double top = 0, rounding = 0;
};
SeriesBound bound_series(std::span<const double> c, double beyond);

// Coefficients of the derivative with respect to t.
std::vector<double> derivative(std::span<const double> c);

// Coefficients of the antiderivative with respect to x = middle + half t that has the value `value` at t = -1; at
// return `value` is that at t = 1.
std::vector<Dd> antiderivative(std::span<const Dd> c, Dd half, Dd& value);

// Coefficients of the product with the linear function a + b t.
std::vector<Dd> times_linear(std::span<const Dd> c, Dd a, Dd b);

// Appends the coefficients divided by `divisor` and rounded to `out`. What that changes the series by at most, |T_j|
// being at most 1: the rounding, and 2^-90 of the coefficients for the arithmetic before, which is some hundred steps
// of 2^-104 each.
double append_rounded(std::span<const Dd> series, Dd divisor, std::vector<double>& out);

}  // namespace moire
