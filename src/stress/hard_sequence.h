// Sequences whose sum is far smaller than their terms: Ogita, Rump and Oishi, "Accurate sum and dot product", SIAM J.
// Sci. Comput. 26, 2005, algorithm 6.1, for sums.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "stress/chance.h"
#include "stress/exact_sum.h"

namespace moire::stress {

// n >= 6 terms up to 2^bits in size whose sum is of the order of 1: a condition number (sum of |x| over |sum|) of about
// 2^bits. Half of them have exponents all over that range; the others take away what has come together, to their own
// exponents, which fall to 0.
inline std::vector<double> hard_sequence(Chance& chance, std::size_t n, int bits) {
  std::vector<double> x;
  ExactSum sum;
  const auto append = [&](double term) {
    x.push_back(term);
    sum.add(term);
  };
  const std::size_t half = n / 2;
  for (std::size_t i = 0; i < half; ++i) {
    // The largest exponent must occur, and so must the smallest.
    const int exponent = i == 0   ? bits
                         : i == 1 ? 0
                                  : static_cast<int>(chance.below(static_cast<std::uint64_t>(bits) + 1));
    append(std::ldexp(chance.between(-1, 1), exponent));
  }
  for (std::size_t i = half; i < n; ++i) {
    const double left = static_cast<double>(n - 1 - i) / static_cast<double>(n - half);
    append(std::ldexp(chance.between(-1, 1), static_cast<int>(bits * left)) - static_cast<double>(sum.value()));
  }
  for (std::size_t i = n - 1; i > 0; --i) std::swap(x[i], x[chance.below(i + 1)]);
  return x;
}

}  // namespace moire::stress
