// The pieces of a kernel as Chebyshev series, and the kernel's values at many points: what rendering spends its time
// on.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>

namespace moire {

// A piece between two knots, t = (x - mid) * inverse_half running from -1 to 1 over it, and where in a list of
// coefficients the series of k begins and that of what k was integrated to.
struct SeriesPiece {
  double mid, half, inverse_half;
  std::size_t k_first, integral_first;
};

// The piece that x lies in, -1 left of the first knot, their number right of the last.
inline int piece_of(std::span<const double> knots, double x) noexcept {
  return static_cast<int>(std::upper_bound(knots.begin(), knots.end(), x) - knots.begin()) - 1;
}

// A view: k on pieces[i] between knots[i] and knots[i + 1], of one degree on all.
struct KernelPieces {
  std::span<const double> knots;
  std::span<const SeriesPiece> pieces;
  const double* coefficients;
  int degree;
};

// out[i] = k(x[i]), 0 left of the first knot and from the last one on; x and out may be the same. The same bits on
// every instruction set.
void weights_of(const KernelPieces& kernel, std::span<const double> x, std::span<double> out) noexcept;

}  // namespace moire
