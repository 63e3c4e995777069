// Tables of the areas that two disks have in common.
#include "measure/discrepancy/disk_overlap.h"

#include <array>
#include <cmath>
#include <initializer_list>
#include <numbers>

namespace moire {
namespace {

constexpr std::size_t kTerms = 7;

// Coefficients in powers of t of the polynomial through f at the 7 Chebyshev points of [-1, 1].
template <class F>
std::array<double, kTerms> chebyshev_fit(const F& f) {
  std::array<double, kTerms> values{}, chebyshev{};
  // The cosines' errors then count by how much f varies.
  const double middle = f(0);
  const auto angle = [](std::size_t j) { return std::numbers::pi * (static_cast<double>(j) + 0.5) / kTerms; };
  for (std::size_t j = 0; j < kTerms; ++j) values[j] = f(std::cos(angle(j))) - middle;
  for (std::size_t k = 0; k < kTerms; ++k) {
    double sum = 0;
    for (std::size_t j = 0; j < kTerms; ++j) sum += values[j] * std::cos(static_cast<double>(k) * angle(j));
    chebyshev[k] = (k == 0 ? 1.0 : 2.0) / kTerms * sum;
  }
  // T_0 = 1, T_1 = t, T_(k+1) = 2 t T_k - T_(k-1)
  std::array<double, kTerms> before{1}, now{0, 1}, powers{};
  for (std::size_t i = 0; i < kTerms; ++i) powers[i] = chebyshev[0] * before[i] + chebyshev[1] * now[i];
  for (std::size_t k = 2; k < kTerms; ++k) {
    std::array<double, kTerms> next{};
    for (std::size_t i = 0; i < kTerms; ++i) next[i] = (i > 0 ? 2 * now[i - 1] : 0.0) - before[i];
    for (std::size_t i = 0; i < kTerms; ++i) powers[i] += chebyshev[k] * next[i];
    before = now;
    now = next;
  }
  powers[0] += middle;
  return powers;
}

double lens_at(double q, double p) noexcept {
  const double c = std::sqrt(q), s = std::sqrt(p);
  return 2 * (std::atan2(s, c) - c * s);
}

double mean_lens_at(double q, double p) noexcept {
  const double c = std::sqrt(q), s = std::sqrt(p);
  const double logarithm = q > 0 ? c * c * c * std::asinh(s / c) : 0.0;  // asinh(s / c) = ln((1 + s) / c)
  return (std::atan2(s, c) - 2 * c * s + logarithm) * 2 / 3;
}

}  // namespace

DiskOverlap::DiskOverlap(Function f) : f_(f), pieces_(2 * static_cast<std::size_t>(kPieces)) {
  const auto edge = [](std::int64_t piece) { return std::bit_cast<double>((kFirst + piece) << kShift); };
  for (std::int64_t i = 1; i < kPieces; ++i) {
    const double from = edge(i - 1), to = edge(i), centre = 0.5 * (from + to), half = 0.5 * (to - from);
    for (const bool small_q : {true, false}) {
      const auto powers = chebyshev_fit([&](double t) {
        const double m = centre + half * t;
        return small_q ? f(m, 1 - m) : f(1 - m, m);
      });
      Piece& piece = pieces_[static_cast<std::size_t>(small_q ? i : kPieces + i)];
      piece.centre = centre;
      double scale = 1;
      for (std::size_t k = 0; k < kTerms; ++k, scale /= half) piece.a[k] = powers[k] * scale;
    }
  }
}

const DiskOverlap& DiskOverlap::lens() {
  static const DiskOverlap table(lens_at);
  return table;
}

const DiskOverlap& DiskOverlap::mean_lens() {
  static const DiskOverlap table(mean_lens_at);
  return table;
}

}  // namespace moire
