// u = 2^-53 is the unit roundoff. A straight-line computation with d roundings on its longest path errs by at most d u
// times the same computation on absolute values, second order apart.
#include "testimages/radial_terms.h"

#include <algorithm>
#include <cmath>

#include "core/rounding.h"
#include "testimages/binomials.h"

namespace moire {
namespace {

using Taylor = std::array<double, kMaxTerms + 1>;
constexpr std::size_t kAll = kMaxTerms + 1;
constexpr double kSlack = 1 + 0x1p-20;

// Majorant of a root less its value at 0, where that is at least `least`: the root of r^2 + 2 b x + A x^2, |b| <= drift
// most and |A| <= drift^2. Every coefficient falls with r.
Taylor root_majorant(double drift, double least, double most) {
  Taylor y{};
  const double q1 = 2 * drift * most / (least * least), q2 = drift / least * (drift / least);
  for (std::size_t i = 1; i < kAll; ++i) {
    double sum = i == 1 ? q1 : i == 2 ? q2 : 0;
    for (std::size_t l = 1; l < i; ++l) sum += y[l] * y[i - l];
    y[i] = 0.5 * sum;
  }
  for (double& x : y) x *= least;
  return y;
}

// The same for a distance from the origin along a straight line: the coefficients of (1 - 2 c x + x^2)^(1/2), |c| <= 1,
// are (P_(n-2)(c) - P_n(c)) / (2 n - 1) with Legendre polynomials (Digital Library of Mathematical Functions, 18.9.7).
Taylor distance_majorant(double drift, double least) {
  Taylor y{};
  double power = drift;
  for (std::size_t i = 1; i < kAll; ++i, power *= drift / least) {
    y[i] = power * (i == 1 ? 1 : 2 / static_cast<double>(2 * i - 1));
  }
  return y;
}

// g_j from kappa, up to the sign of both: e and signs as they come.
double term(const Taylor& kappa, std::size_t j, double e) {
  double sum = 0, power = 1, factorial = 1;
  for (std::size_t i = j + 1; i-- > 0; power *= e) sum += kBinomials[j + 2][j - i] * power * kappa[i];
  for (std::size_t i = 2; i <= j; ++i) factorial *= static_cast<double>(i);
  return factorial * sum;
}

// Of a majorant: with |e|, and by how much it grows with it.
TermBounds terms_of(const Taylor& kappa, double e) {
  TermBounds out{};
  for (std::size_t j = 0; j < kAll; ++j) out[j] = term(kappa, j, e) * kSlack;
  return out;
}
TermBounds slopes_of(const Taylor& kappa, double e) {
  TermBounds out{};
  double factorial = 1;
  for (std::size_t j = 1; j < kAll; ++j) {
    factorial *= static_cast<double>(j);
    double power = 1;
    for (std::size_t i = j; i-- > 0; power *= e) {
      out[j] += factorial * kBinomials[j + 2][j - i] * static_cast<double>(j - i) * power * kappa[i] * kSlack;
    }
  }
  return out;
}

}  // namespace

RadialTerms::RadialTerms(const BoardFrame& frame, const PieceWeight& piece, double deepest) : k_(piece, kAll) {
  const BoardFrame::Drift g = frame.drift({0, 0}, deepest);
  const Bounded e = frame.e_times(deepest);
  gx_ = g.x.value, gy_ = g.y.value, e_ = e.value;
  drift_error_ = std::hypot(g.x.error, g.y.error) * kSlack;
  e_error_ = e.error;
}

void RadialTerms::at(Vec2 p, int count, double* g) const {
  const double r = std::sqrt(p.x * p.x + p.y * p.y);
  const auto terms = static_cast<std::size_t>(count);
  if (count == 1) return k_.at(r, 1, g);
  Taylor k{}, d{}, kappa{};
  k_.at(r, terms, k.data());
  const double ax = gx_ - e_ * p.x, ay = gy_ - e_ * p.y;
  const double half_inverse = 0.5 / r;
  d[1] = (p.x * ax + p.y * ay) / r;
  for (std::size_t i = 2; i < terms; ++i) {
    double sum = i == 2 ? ax * ax + ay * ay : 0;
    for (std::size_t l = 1; l < i; ++l) sum -= d[l] * d[i - l];
    d[i] = sum * half_inverse;
  }
  compose(k.data(), d.data(), terms, kappa.data());
  for (std::size_t j = 0; j < terms; ++j) {
    const double value = term(kappa, j, -e_);
    g[j] = j % 2 == 0 ? value : -value;
  }
}

double RadialTerms::drift(double r) const {
  return (std::hypot(gx_, gy_) + drift_error_ + (std::fabs(e_) + e_error_) * r) * kSlack;
}

// |g_j| where the Taylor coefficients of k are at most k and those of the distance at most so much.
TermBounds RadialTerms::majorant(const double* k, const double* distance) const {
  Taylor kappa{};
  compose(k, distance, kAll, kappa.data());
  return terms_of(kappa, std::fabs(e_) + e_error_);
}

TermBounds RadialTerms::top(double low, double high) const {
  return majorant(k_.bounds(0).data(), distance_majorant(drift(high), low).data());
}

TermBounds RadialTerms::top(const TermBounds& along, double high) const {
  Taylor kappa = along;
  double power = 1;
  for (double& x : kappa) {
    x *= power;
    power *= drift(high);
  }
  return terms_of(kappa, std::fabs(e_) + e_error_);
}

TermBounds RadialTerms::error(double low, double high) const {
  const double most = drift(high), e = std::fabs(e_) + e_error_;
  const Taylor root = root_majorant(most, low, low);
  Taylor kappa{};
  compose(k_.bounds(0).data(), root.data(), kAll, kappa.data());
  const TermBounds size = terms_of(kappa, e), from_e = slopes_of(kappa, e),
                   from_k = majorant(k_.errors().data(), root.data());
  // The drift: its own error and 3 roundings of its parts.
  const double drift_share = most > 0 ? (drift_error_ + e_error_ * high) / most + 4 * kUnit : 0;
  // A point on a side is rounded, as are the side's ends: by 4 u of its coordinates.
  const double reach = 0.25 * scale(low), moved = 8 * kUnit * high / reach;
  const TermBounds around = nearby(low, high, reach);
  TermBounds out{};
  for (std::size_t j = 0; j < kAll; ++j) {
    // The root's coefficient i is a tree of i leaves, each right to 8 u, with i + 4 roundings a node; the composition
    // has j steps of sums of at most j products; then the sum over i and its factors.
    const auto n = static_cast<double>(j);
    const double roundings = j == 0 ? 0 : n * (n + 16) + n * (n + 2) + 4 * n + 8;
    out[j] = ((roundings * kUnit + n * drift_share) * size[j] + from_k[j] + from_e[j] * e_error_ + moved * around[j]) *
             kSlack;
  }
  return out;
}

// |r'^2 - r^2| <= 2 r reach + reach^2 where |p' - p| <= reach.
TermBounds RadialTerms::nearby(double low, double high, double reach) const {
  const double least = std::sqrt(low * low - 2 * low * reach - reach * reach);
  const double beyond = (2 * reach + reach * reach / low) / (1 + least / low) * kSlack;
  return majorant(k_.bounds(beyond).data(), root_majorant(drift(high + reach), least, high + reach).data());
}

// Taylor's theorem from the knot, with the last coefficient as the remainder's.
TermBounds RadialTerms::jump(const RadialTerms& inner, const RadialTerms* outer, double knot, double within) {
  constexpr std::size_t kLast = kAll - 1;
  Taylor k{}, beyond{};
  inner.k_.at(knot, kAll, k.data());
  if (outer != nullptr) outer->k_.at(knot, kAll, beyond.data());
  for (std::size_t n = 0; n < kAll; ++n) {
    k[n] = std::fabs(k[n] - beyond[n]) + inner.k_.errors()[n] + (outer != nullptr ? outer->k_.errors()[n] : 0);
  }
  k[kLast] = inner.k_.bounds(0)[kLast] + (outer != nullptr ? outer->k_.bounds(within)[kLast] : 0);
  for (std::size_t n = 0; n < kLast; ++n) {
    double power = 1;
    for (std::size_t l = n + 1; l < kAll; ++l) {
      power *= within;
      k[n] += kBinomials[l][n] * k[l] * power;
    }
  }
  return inner.majorant(k.data(), distance_majorant(inner.drift(knot), knot - within).data());
}

double RadialTerms::scale(double r) const { return std::min(0.25 * r, 0.5 * k_.half()); }

}  // namespace moire
