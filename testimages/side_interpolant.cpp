#include "testimages/side_interpolant.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/rounding.h"
#include "testimages/chebyshev_family.h"

namespace moire {
namespace {

// A stretch is no longer than this many half lengths. With kBeside = 1/4 around it, it lies in a Bernstein ellipse of
// parameter 16: half its length times (16 - 1/16) / 2 is just below that. Shorter ones lie in larger ellipses.
constexpr double kLongest = 1.0 / 16, kRho = 16;
static_assert(0.5 * kLongest * (kRho - 1 / kRho) / 2 < kBeside);
constexpr std::size_t kFewest = 4, kMost = 13;

// Chebyshev points of the second kind, and what makes coefficients of values there.
struct Rule {
  std::array<double, kMost> place{};
  std::array<std::array<double, kMost>, kMost> coefficient{};
  explicit Rule(std::size_t points) {
    const std::size_t degree = points - 1;
    const auto n = static_cast<double>(degree);
    for (std::size_t l = 0; l < points; ++l) place[l] = std::cos(std::numbers::pi * static_cast<double>(l) / n);
    for (std::size_t i = 0; i < points; ++i) {
      for (std::size_t l = 0; l < points; ++l) {
        const double half_i = i == 0 || i == degree ? 0.5 : 1, half_l = l == 0 || l == degree ? 0.5 : 1;
        const auto turn = static_cast<double>(i * l % (2 * degree));
        coefficient[i][l] = 2 / n * half_i * half_l * std::cos(std::numbers::pi * turn / n);
      }
    }
  }
};

const Rule& rule(std::size_t points) {
  static const auto rules = [] {
    std::vector<Rule> made;
    for (std::size_t n = kFewest; n <= kMost; ++n) made.emplace_back(n);
    return made;
  }();
  return rules[points - kFewest];
}

// What a polynomial through so many points misses per unit of the bound in the ellipse of parameter rho: 4 rho^-degree
// / (rho - 1) (Trefethen, "Approximation Theory and Approximation Practice", 2013, thm 8.2).
double missed_with(std::size_t points, double rho) {
  return 4 * std::pow(rho, 1 - static_cast<double>(points)) / (rho - 1);
}

}  // namespace

SideInterpolant::SideInterpolant(std::function<void(double, int, double*)> exact, double extent)
    : exact_(std::move(exact)), stretches_(std::max(1.0, std::ceil(extent / kLongest))), points_(kFewest) {
  const double rho = kRho * kLongest * stretches_ / extent, enough = missed_with(kMost, kRho);
  while (points_ < kMost && missed_with(points_, rho) > enough) ++points_;
}

void SideInterpolant::at(double tau, int count, double* g) {
  const double stretch = std::clamp(std::floor(tau * stretches_), 0.0, stretches_ - 1);
  if (stretch != current_) {
    current_ = stretch;
    asked_ = known_ = 0;
  }
  if (count > known_) {
    if (++asked_ <= static_cast<int>(points_)) return exact_(tau, count, g);
    make(count);
  }
  const double t = 2 * (tau * stretches_ - stretch) - 1;
  if (count > 1) return clenshaw(series_.data(), points_, kMaxTerms, static_cast<std::size_t>(count), t, g);
  double b1 = 0, b2 = 0;
  for (std::size_t i = points_; i-- > 1;) {
    const double b = series_[i * kMaxTerms] + (2 * t * b1 - b2);
    b2 = b1;
    b1 = b;
  }
  g[0] = series_[0] + (t * b1 - b2);
}

void SideInterpolant::make(int count) {
  known_ = count;
  asked_ = 0;
  series_.assign(points_ * kMaxTerms, 0);
  const Rule& use = rule(points_);
  double g[kMaxTerms];
  for (std::size_t l = 0; l < points_; ++l) {
    exact_((current_ + 0.5 + 0.5 * use.place[l]) / stretches_, count, g);
    for (std::size_t i = 0; i < points_; ++i)
      for (std::size_t j = 0; j < static_cast<std::size_t>(count); ++j)
        series_[i * kMaxTerms + j] += use.coefficient[i][l] * g[j];
  }
}

// Errors of values grow by the Lebesgue constant of 13 points, below 2.7. Of coefficients: sums of 13 products, their
// factors right to 4 u, of values of at most `top`, 13 of them; coefficient i is at most 2 M rho^-i with M the bound in
// the ellipse, so that Clenshaw's roundings come to less than 3 u times the sum of 2 M (i + 1) (i + 2) rho^-i, below
// 20 u M with 5 M of slope for t, right to 3 u.
TermBounds SideInterpolant::error(const TermBounds& exact, const TermBounds& top, const TermBounds& nearby) {
  TermBounds out{};
  const double missed = missed_with(kMost, kRho);
  for (std::size_t j = 0; j < out.size(); ++j) {
    out[j] = 2.7 * exact[j] + 13 * 20 * kUnit * top[j] + (missed + 40 * kUnit) * nearby[j];
  }
  return out;
}

}  // namespace moire
