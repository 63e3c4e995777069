// With K(t) = k(r), t = r^2, the weight along a line is K(t + 2 b s + s^2), b = p . d: its i-th coefficient is
//
//   sum over n of K_n binomial(n, i - n) (2 b)^(2n - i),   K_n the Taylor coefficients of K at t,
//
// a polynomial of degree i in b, |b| <= r. In the middle of the ring the K_n are those of a composition; elsewhere they
// differ by no more than a sum over higher ones, the last of which are bounded by Cauchy's estimate. A polynomial of
// degree i on [-1, 1] is at most its largest value at N > i Chebyshev points over cos(i pi / (2 N)): Ehlich and Zeller,
// "Schwankung von Polynomen zwischen Gitterpunkten", Mathematische Zeitschrift 86, 1964.
#include "testimages/radial_rings.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/double_double.h"
#include "testimages/binomials.h"
#include "testimages/chebyshev_family.h"
#include "testimages/radial_taylor.h"

namespace moire {
namespace {

constexpr std::size_t kTaylor = 25;  // coefficients of K that are known one by one
constexpr std::size_t kPoints = 64;
// Rings reach from about (1 - kWidth) t to (1 + kWidth) t, and are thin against the disk; K is analytic in kDisk t
// around t, and bounded there by the piece's series, within about kBeyondPiece half lengths of the piece, if that is
// short.
constexpr double kWidth = 0.05, kDisk = 0.8, kBeyondPiece = 1, kOfDisk = 0.1;
constexpr double kBeforePiece = 0.002;  // half lengths
// In double-double, rounding errors are far below this share of sums of absolute values.
constexpr double kRounding = 0x1p-84;

// One piece's k: the Chebyshev series of its Taylor coefficients.
class SharpTaylor {
 public:
  explicit SharpTaylor(const PieceWeight& piece)
      : size_(piece.series.size()),
        mid_(Dd(0.5) * two_sum(piece.low, piece.high)),
        inverse_half_(Dd(2.0) / two_sum(piece.high, -piece.low)),
        c_(kTaylor * size_) {
    for (std::size_t i = 0; i < size_; ++i) c_[i] = piece.series[i];
    for (std::size_t n = 1; n < kTaylor; ++n) {
      derive(&c_[(n - 1) * size_], size_, &c_[n * size_]);
      const Dd factor = inverse_half_ / Dd(static_cast<double>(n));
      for (std::size_t i = 0; i < size_; ++i) c_[n * size_ + i] = c_[n * size_ + i] * factor;
    }
  }

  // At r: the coefficients, and what they may come to by absolute values.
  void at(double r, Dd* value, double* size) const {
    const Dd t = (Dd(r) - mid_) * inverse_half_;
    for (std::size_t n = 0; n < kTaylor; ++n) {
      value[n] = clenshaw(&c_[n * size_], size_, t);
      size[n] = 0;
      for (std::size_t i = 0; i < size_; ++i) {
        const auto order = static_cast<double>(i + 1);
        size[n] += order * order * std::fabs(c_[n * size_ + i].hi);
      }
    }
  }

 private:
  std::size_t size_;
  Dd mid_, inverse_half_;
  std::vector<Dd> c_;
};

RadialRing ring_of(std::size_t piece, const SharpTaylor& k, const RadialTaylor& bounds, double low, double high,
                   double disk) {
  const double r = std::sqrt(0.5 * (low * low + high * high)), t = r * r;
  const double h = std::max((high - r) * (high + r), (r - low) * (r + low)) * (1 + 0x1p-40);
  // K = k(root of t) in the middle; the same on absolute values.
  Dd at[kTaylor], root[kTaylor], value[kTaylor];
  double at_size[kTaylor], root_size[kTaylor], size[kTaylor];
  k.at(r, at, at_size);
  root[0] = 0.0;
  Dd c = r;
  const Dd square = two_prod(r, r);
  for (std::size_t l = 1; l < kTaylor; ++l) {
    c = c * Dd(0.5 - static_cast<double>(l - 1)) / (square * Dd(static_cast<double>(l)));
    root[l] = c;
  }
  for (std::size_t l = 0; l < kTaylor; ++l) root_size[l] = std::fabs(root[l].hi);
  compose(at, root, kTaylor, value);
  compose(at_size, root_size, kTaylor, size);
  // |K| in the disk: the root of t (1 + z), |z| <= disk / t, is off by at most r (1 - (1 - |z|)^(1/2)).
  const double most = bounds.bounds(r * (1 - std::sqrt(1 - disk / t)) * (1 + 0x1p-40))[0];

  // By how much K_n may differ from the one in the middle.
  TermBounds off{};
  for (std::size_t n = 0; n <= kMaxTerms; ++n) {
    double power = 1;
    off[n] = kRounding * size[n] + 0x1p-50 * std::fabs(value[n].hi);
    for (std::size_t l = n + 1; l < kTaylor; ++l) {
      power *= h;
      off[n] += kBinomials[l][n] * (std::fabs(value[l].hi) + kRounding * size[l]) * power;
    }
    // The rest, |K_l| <= most / disk^l: terms that fall by this ratio or faster.
    const auto first = static_cast<double>(kTaylor), order = static_cast<double>(n);
    const double ratio = (first + 1) / (first + 1 - order) * h / disk;
    const double term = kBinomials[kTaylor][n] * most * std::pow(h / disk, first - order) / std::pow(disk, order);
    off[n] += ratio < 0.99 ? term / (1 - ratio) : HUGE_VAL;
  }

  RadialRing ring{piece, low, high, {}};
  for (std::size_t i = 0; i <= kMaxTerms; ++i) {
    const std::size_t first = (i + 1) / 2;
    // b^(2 first - i), which is 1 or b, times a polynomial in b^2.
    const auto sum_at = [&](double b, const auto& of) {
      double sum = 0;
      for (std::size_t n = i + 1; n-- > first;) sum = sum * b * b + of(n) * kBinomials[n][i - n];
      return i % 2 == 0 ? sum : sum * b;
    };
    double largest = 0;
    for (std::size_t q = 0; q <= kPoints / 2; ++q) {  // even or odd in b
      const double b = 2 * high * std::cos(std::numbers::pi * (static_cast<double>(q) + 0.5) / kPoints);
      largest = std::max(largest, std::fabs(sum_at(b, [&](std::size_t n) { return value[n].hi; })));
    }
    const double order = static_cast<double>(i);
    ring.along[i] = largest / std::cos(order * std::numbers::pi / (2 * kPoints)) +
                    sum_at(2 * high, [&](std::size_t n) { return off[n] + 0x1p-46 * std::fabs(value[n].hi); });
    ring.along[i] *= 1 + 0x1p-20;
  }
  return ring;
}

std::vector<RadialRing> radial_rings(std::span<const PieceWeight> pieces) {
  std::vector<RadialRing> out;
  const double innermost = std::min(kInnermost * pieces.back().high, 0.5 * pieces.front().high);
  for (std::size_t i = pieces.size(); i-- > 0;) {
    const SharpTaylor k(pieces[i]);
    const RadialTaylor bounds(pieces[i], 1);
    const double least = std::max(pieces[i].low, innermost);
    for (double high = pieces[i].high; high > least;) {
      // A disk of radius d around t holds roots no further than d / (2 r) / (1 - kDisk)^(1/2) away, or so.
      const double t = high * high, disk = std::min(kDisk * t, kBeyondPiece * 1.4 * bounds.half() * high);
      const double half = std::min(kWidth * t, kOfDisk * disk);
      const double low = std::max(least, std::sqrt(std::max(t - 2 * half, 0.0)));
      // Also a little before the piece, where the polygon along a knot's circle leaves it (radial_series.h).
      const double from = i > 0 && low == pieces[i].low ? low - kBeforePiece * bounds.half() : low;
      out.push_back(ring_of(i, k, bounds, from, high, disk * (1 - 2 * kWidth)));
      high = low;
    }
  }
  return out;
}

}  // namespace

std::span<const RadialRing> RadialWeight::rings() const {
  std::call_once(once_, [this] { rings_ = radial_rings(pieces); });
  return rings_;
}

}  // namespace moire
