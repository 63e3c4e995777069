// The Taylor coefficients of one piece of a radial weight k(r) at any r.
#pragma once

#include <cstddef>
#include <vector>

#include "curve/piece_weight.h"

namespace moire {

// k is the piece's polynomial, also a little beyond its ends.
class RadialTaylor {
 public:
  // The first `count` coefficients, k^(n) / n!; at most kMaxTerms + 1.
  RadialTaylor(const PieceWeight& piece, std::size_t count);

  double half() const { return half_; }  // of the piece's length
  // The first n of them at r, to out.
  void at(double r, std::size_t n, double* out) const;
  // Bounds on the errors of at() on the piece.
  const std::vector<double>& errors() const { return lost_; }
  // Bounds on the coefficients at complex places within `beyond` of the piece.
  std::vector<double> bounds(double beyond) const;

 private:
  std::size_t count_, size_;
  double mid_, half_, inverse_half_;
  std::vector<double> c_;  // Chebyshev series: coefficient i of all at i count
  std::vector<double> lost_;
};

// The first n coefficients of the sum of k_i d^i, d_0 = 0, to out; all of n, n > 0.
template <class T>
void compose(const T* k, const T* d, std::size_t n, T* out) {
  out[0] = k[n - 1];
  for (std::size_t m = n - 1; m-- > 0;) {
    // m factors d, each without a constant, are still to come: what would end up beyond the last is not needed.
    for (std::size_t i = n - 1 - m; i > 0; --i) {
      T sum = 0.0;
      for (std::size_t l = 0; l < i; ++l) sum = sum + out[l] * d[i - l];
      out[i] = sum;
    }
    out[0] = k[m];
  }
}

}  // namespace moire
