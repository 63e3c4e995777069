// How far a statistic is from what chance allows, in standard deviations of a normal law. All tests of random numbers
// run at fixed seeds, so they pass or fail always; a limit of z = 5 means that a fresh seed of a perfect generator
// would fail with probability 6e-7, z = 6 with 2e-9.
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

namespace moire::test {

// The normal deviate of a chi-square value; negative: too even. (E. B. Wilson and M. M. Hilferty, "The distribution of
// chi-square", PNAS 17, 1931; its error is below 0.1 for |z| <= 5 and 30 or more degrees of freedom.)
inline double z_of_chi_square(double value, double degrees) {
  const double spread = 2 / (9 * degrees);
  return (std::cbrt(value / degrees) - (1 - spread)) / std::sqrt(spread);
}

// Counts in cells that all have the same probability.
inline double z_of_counts(const std::vector<std::uint32_t>& counts) {
  double total = 0, value = 0;
  for (const std::uint32_t c : counts) total += c;
  const double expected = total / static_cast<double>(counts.size());
  for (const std::uint32_t c : counts) value += (c - expected) * (c - expected) / expected;
  return z_of_chi_square(value, static_cast<double>(counts.size()) - 1);
}

// A sum of rare events against its Poisson mean (20 or more).
inline double z_of_poisson(double events, double mean) { return (events - mean) / std::sqrt(mean); }

}  // namespace moire::test
