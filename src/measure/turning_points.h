// Where a smooth function of one variable turns, and where it changes sign: from its Chebyshev series.
//
// L. N. Trefethen, "Approximation Theory and Approximation Practice", 2013, chapters 3 and 19; extrema and roots of
// such series are those of the Chebfun system. What is found is good to rounding where the slope crosses zero at an
// angle. What is missed are pairs of turning points closer than about 1/4 of the spacing of the series' own nodes:
// between those the function hardly moves.
#pragma once

#include <functional>
#include <vector>

namespace moire {

// Places strictly inside (a, b), a < b, in increasing order, where the slope of f changes sign. f is a polynomial of
// `degree` >= 0 there, or one of that degree in all but rounding; it is evaluated degree + 1 times, inside (a, b).
std::vector<double> turning_points(const std::function<double(double)>& f, int degree, double a, double b);

// Places strictly inside (a, b), in increasing order, where f itself changes sign; f is evaluated also at a and b.
std::vector<double> sign_changes(const std::function<double(double)>& f, int degree, double a, double b);

}  // namespace moire
