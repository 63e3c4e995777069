// Knots for kernels that are smooth throughout: pieces of one length, short enough for a series of low degree.
#pragma once

#include <vector>

namespace moire {

// 2 n pieces of equal length from -radius to radius, one knot at 0; both ends exact. With n = radius all are whole.
inline std::vector<double> even_knots(double radius, int n) {
  std::vector<double> knots;
  for (int i = -n; i <= n; ++i) knots.push_back(i == -n ? -radius : i == n ? radius : radius * i / n);
  return knots;
}

// n pieces of equal length from 0 to radius, for radial kernels.
inline std::vector<double> even_knots_from_zero(double radius, int n) {
  const std::vector<double> both = even_knots(radius, n);
  return {both.begin() + n, both.end()};
}

}  // namespace moire
