// Radical inverses in base 3, with a number added to each digit modulo 3: the third coordinate of Hammersley points
// (J. H. Halton, "On the efficiency of certain quasi-random sequences of points in evaluating multi-dimensional
// integrals", Numer. Math. 2, 1960), its folded form (T. T. Warnock, 1972) and its random digital shifts.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace moire {

// Digits kept: enough to tell 2^26 points apart, and a multiple of 3, the period of the folding.
inline constexpr int kTernaryDigits = 18;
inline constexpr std::int32_t kTernaryCells = 387'420'489;  // 3^18

// A number for each digit, 0, 1 or 2; [0] belongs to the first one after the point.
using TernaryDigits = std::array<int, kTernaryDigits>;

// What folding adds to digit k: k mod 3.
constexpr TernaryDigits ternary_folding() noexcept {
  TernaryDigits digits{};
  for (std::size_t k = 0; k < digits.size(); ++k) digits[k] = static_cast<int>(k % 3);
  return digits;
}

// cell[i] = sum over k of ((a_k + add_k) mod 3) 3^(17-k), with a_k digit k of i, k = 0 the least significant: the first
// 18 digits of the radical inverse as a whole number, exact. cell[0], cell[1], ... at most 3^18 of them.
//
// The 3^k points that follow digit k = 0 repeat with digit 1 and 2, moved by the change of that digit alone: one
// addition a point.
inline void ternary_inverses(const TernaryDigits& add, std::span<double> cell) noexcept {
  if (cell.empty()) return;
  cell[0] = 0;
  for (const int d : add) cell[0] = 3 * cell[0] + d;
  double weight = kTernaryCells / 3;
  std::size_t done = 1;
  for (std::size_t k = 0; done < cell.size(); ++k, weight /= 3) {
    const std::size_t block = done;
    for (int digit = 1; digit <= 2 && done < cell.size(); ++digit) {
      const double step = ((add[k] + digit) % 3 - add[k]) * weight;
      const std::size_t count = std::min(block, cell.size() - done);
      const double* __restrict from = cell.data();
      double* __restrict to = cell.data() + done;
      for (std::size_t i = 0; i < count; ++i) to[i] = from[i] + step;
      done += count;
    }
  }
}

// phi_3(0), phi_3(1), ..., correctly rounded: only the division rounds.
inline void phi3(std::span<double> t) noexcept {
  ternary_inverses({}, t);
  for (double& v : t) v /= kTernaryCells;
}

// psi_3(0), psi_3(1), ..., correctly rounded. Digit k becomes (a_k + k) mod 3, also the infinitely many leading zeros
// of i. Behind the 18 digits A they leave the tail 0.012012... = 5/26, so psi = (26 A + 5) / (26 * 3^18). Only the
// division rounds, since both of its sides are below 2^34.
inline void psi3(std::span<double> t) noexcept {
  ternary_inverses(ternary_folding(), t);
  for (double& v : t) v = (26 * v + 5) / (26.0 * kTernaryCells);
}

}  // namespace moire
