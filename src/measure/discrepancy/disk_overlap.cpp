// Tables of the areas that two disks have in common.
#include "measure/discrepancy/disk_overlap.h"

#include <array>
#include <cmath>
#include <initializer_list>
#include <numbers>

#include "core/dd_math.h"

namespace moire {
namespace {

constexpr std::size_t kTerms = 8;
using Terms = std::array<double, kTerms>;

// From the values of f at the Chebyshev points of [-1, 1] to the polynomial through them, in powers of t.
class ChebyshevFit {
 public:
  ChebyshevFit() {
    for (std::size_t j = 0; j < kTerms; ++j)
      for (std::size_t k = 0; k < kTerms; ++k)
        cosines_[k][j] = std::cos(static_cast<double>(k) * std::numbers::pi * (static_cast<double>(j) + 0.5) / kTerms);
  }

  template <class F>
  Terms operator()(const F& f) const {
    Terms values{}, chebyshev{};
    // The cosines' errors then count by how much f varies.
    const Dd middle = f(0);
    for (std::size_t j = 0; j < kTerms; ++j) values[j] = (f(cosines_[1][j]) - middle).value();
    for (std::size_t k = 0; k < kTerms; ++k) {
      double sum = 0;
      for (std::size_t j = 0; j < kTerms; ++j) sum += values[j] * cosines_[k][j];
      chebyshev[k] = (k == 0 ? 1.0 : 2.0) / kTerms * sum;
    }
    // T_0 = 1, T_1 = t, T_(k+1) = 2 t T_k - T_(k-1)
    Terms before{1}, now{0, 1}, powers{};
    for (std::size_t i = 0; i < kTerms; ++i) powers[i] = chebyshev[0] * before[i] + chebyshev[1] * now[i];
    for (std::size_t k = 2; k < kTerms; ++k) {
      Terms next{};
      for (std::size_t i = 0; i < kTerms; ++i) next[i] = (i > 0 ? 2 * now[i - 1] : 0.0) - before[i];
      for (std::size_t i = 0; i < kTerms; ++i) powers[i] += chebyshev[k] * next[i];
      before = now;
      now = next;
    }
    powers[0] = (middle + powers[0]).value();
    return powers;
  }

 private:
  std::array<Terms, kTerms> cosines_;  // of k times the angle of point j
};

// acos c = asin s. The angle is rounded as little as possible: errors of the values go into the table whole.
Dd angle(double c, double s) noexcept { return c < s ? kPi / Dd(2.0) - std::atan2(c, s) : Dd(std::atan2(s, c)); }

Dd lens_at(double q, double p) noexcept {
  const double c = std::sqrt(q), s = std::sqrt(p);
  return Dd(2.0) * (angle(c, s) - two_prod(c, s));
}

Dd mean_lens_at(double q, double p) noexcept {
  const double c = std::sqrt(q), s = std::sqrt(p);
  const double logarithm = q > 0 ? c * c * c * std::asinh(s / c) : 0.0;  // asinh(s / c) = ln((1 + s) / c)
  return (angle(c, s) - two_prod(2 * c, s) + logarithm) * Dd(2.0) / Dd(3.0);
}

}  // namespace

DiskOverlap::DiskOverlap(Function f) : pieces_(2 * static_cast<std::size_t>(kPieces)) {
  const ChebyshevFit fit;
  const auto edge = [](std::int64_t piece) { return std::bit_cast<double>((kFirst + piece) << kShift); };
  pieces_[0].a[0] = f(0, 1).value();
  pieces_[1].a[0] = f(1, 0).value();
  for (std::int64_t i = 1; i < kPieces; ++i) {
    const double from = edge(i), to = edge(i + 1), centre = 0.5 * (from + to), half = 0.5 * (to - from);
    for (const bool small_q : {true, false}) {
      const Terms powers = fit([&](double t) {
        const double m = centre + half * t;
        return small_q ? f(m, 1 - m) : f(1 - m, m);
      });
      Piece& piece = pieces_[static_cast<std::size_t>(2 * i + (small_q ? 0 : 1))];
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
