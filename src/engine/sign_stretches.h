// Where a polynomial is positive and where negative: bisection with Chebyshev points, after H. Ehlich and K. Zeller,
// "Schwankung von Polynomen zwischen Gitterpunkten", Mathematische Zeitschrift 86, 1964.
#pragma once

#include <functional>
#include <span>
#include <vector>

namespace moire {

// A polynomial as it is evaluated.
struct EvaluatedPolynomial {
  std::function<void(std::span<const double> x, double* out)> at;  // out[i] = its value at x[i]
  int degree = 0;
  double largest = 0;  // bound on its absolute value between begin and end
  double error = 0;    // bound on the error of a value
  double begin = 0, end = 0;
};

// One sign from begin to end, +1 or -1.
struct SignStretch {
  double begin = 0, end = 0;
  int sign = 1;
};

// The stretches in order, side by side: they cover [begin, end] unless the polynomial is no larger than its error all
// over it, when there are none. A sign is wrong only where the value is below 6 times its error, and within
// kNarrowest (end - begin) of a place where two zeros may be that the bisection did not tell apart; there it is below
// twice that distance times the largest slope.
std::vector<SignStretch> sign_stretches(const EvaluatedPolynomial& polynomial);

// Intervals below this share of the whole are not halved.
inline constexpr double kNarrowest = 0x1p-45;

}  // namespace moire
