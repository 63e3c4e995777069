// Kernels as quadrature sees them: pieces that a few nodes resolve, their masses, and values.
#include "oracle/kernel.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace moire::oracle {
namespace {

// The longest piece of a kernel of exponential type w, times w. Twelve nodes leave (w h)^24 3e-31 < 1e-22 of sin(w x)
// on a piece of half length h (the remainder of Gauss-Legendre, f^(2n) (2h)^(2n+1) n!^4 / ((2n+1) (2n)!^3)); along a
// line k and its integral make 2 w, of which fourteen nodes leave (2 w h)^28 4e-38 < 1e-19.
constexpr long double kPieceTimesType = 4.4L;
constexpr int kSmoothNodes = 12;

HalfKernel resolved(HalfKernel half) {
  if (half.degree >= 0) return half;
  std::vector<long double> fine{0};
  for (std::size_t i = 0; i + 1 < half.breaks.size(); ++i) {
    const long double a = half.breaks[i], length = half.breaks[i + 1] - a;
    const int parts = static_cast<int>(std::ceil(length * half.type / kPieceTimesType));
    for (int p = 1; p < parts; ++p)
      fine.push_back(a + length * static_cast<long double>(p) / static_cast<long double>(parts));
    fine.push_back(half.breaks[i + 1]);
  }
  half.breaks = std::move(fine);
  return half;
}

Rule inner_rule(int degree) { return Rule(degree < 0 ? kSmoothNodes : degree / 2 + 1); }

// Along a line the kernel, of degree d, times its integral, d + 1, is of degree 2 d + 1.
RulePair line_rules(int degree) {
  return degree < 0 ? RulePair{Rule(14), Rule(20)} : RulePair{Rule(degree + 1), Rule(degree + 3)};
}

}  // namespace

Kernel::Kernel(std::string_view text) : Kernel(half_kernel(parse_spec(text, "oracle"))) {}

Kernel::Kernel(const HalfKernel& half)
    : half_(resolved(half)), inner_(inner_rule(half.degree)), line_rules_(oracle::line_rules(half.degree)) {
  for (std::size_t i = half_.breaks.size(); i-- > 1;) knots_.push_back(-half_.breaks[i]);
  knots_.insert(knots_.end(), half_.breaks.begin(), half_.breaks.end());
  if (half_.degree >= 0) tabulate();
  long double total = 0;
  for (std::size_t i = 0; i + 1 < knots_.size(); ++i) {
    const long double mid = (knots_[i] + knots_[i + 1]) / 2, length = (knots_[i + 1] - knots_[i]) / 2;
    long double mass = 0;
    for (std::size_t n = 0; n < inner_.x.size(); ++n)
      mass += length * inner_.w[n] * (*this)(mid + length * inner_.x[n]);
    mass_.push_back(mass);
    total += mass;
  }
  scale_ = 1 / total;
  for (long double& m : mass_) m *= scale_;
  gain_ = absolute();
}

// Some definitions are slow (a spline through data, a recurrence): polynomials are asked for degree + 1 values a piece
// and are then known. Newton's divided differences at Chebyshev points, which lose nothing at degrees up to 9.
void Kernel::tabulate() {
  const auto count = static_cast<std::size_t>(half_.degree) + 1;
  for (std::size_t i = 0; i < count; ++i)
    nodes_.push_back(std::cos(std::numbers::pi_v<long double> * (static_cast<long double>(i) + 0.5L) /
                              static_cast<long double>(count)));
  for (std::size_t piece = 0; piece + 1 < half_.breaks.size(); ++piece) {
    const long double a = half_.breaks[piece], b = half_.breaks[piece + 1];
    std::vector<long double> d;
    for (const long double t : nodes_) d.push_back(half_.shape((a + b) / 2 + (b - a) / 2 * t));
    for (std::size_t order = 1; order < count; ++order)
      for (std::size_t i = count; i-- > order;) d[i] = (d[i] - d[i - 1]) / (nodes_[i] - nodes_[i - order]);
    newton_.insert(newton_.end(), d.begin(), d.end());
  }
}

long double Kernel::value(long double x) const {
  if (nodes_.empty()) return half_.shape(x);
  std::size_t piece = 0;
  while (piece + 2 < half_.breaks.size() && x >= half_.breaks[piece + 1]) ++piece;
  const long double a = half_.breaks[piece], b = half_.breaks[piece + 1], t = (x - a - (b - x)) / (b - a);
  const long double* c = newton_.data() + piece * nodes_.size();
  long double sum = 0;
  for (std::size_t i = nodes_.size(); i-- > 0;) sum = sum * (t - nodes_[i]) + c[i];
  return sum;
}

long double Kernel::over(long double a, long double b) const {
  long double sum = 0;
  for (std::size_t i = 0; i + 1 < knots_.size(); ++i) {
    const long double lo = std::max(a, knots_[i]), hi = std::min(b, knots_[i + 1]);
    if (lo >= hi) continue;
    if (lo == knots_[i] && hi == knots_[i + 1]) {
      sum += mass_[i];
      continue;
    }
    const long double mid = (lo + hi) / 2, half = (hi - lo) / 2;
    long double part = 0;
    for (std::size_t n = 0; n < inner_.x.size(); ++n) part += inner_.w[n] * (*this)(mid + half * inner_.x[n]);
    sum += part * half;
  }
  return sum;
}

// Between zeros, which lie anywhere in a piece. Found among 64 intervals a piece, more than kernels have turns there;
// where k only touches zero nothing is lost.
long double Kernel::absolute() const {
  constexpr int kIntervals = 64;
  std::vector<long double> cut;
  for (std::size_t piece = 0; piece + 1 < half_.breaks.size(); ++piece) {
    const long double a = half_.breaks[piece], b = half_.breaks[piece + 1];
    // Of neighbours the same number, or a zero on it could be missed; the last one is still in this piece.
    const auto end = [&](int i) {
      return i == kIntervals ? std::nextafter(b, a) : a + (b - a) / kIntervals * static_cast<long double>(i);
    };
    cut.push_back(a);
    for (int i = 0; i < kIntervals; ++i) {
      long double lo = end(i), hi = end(i + 1);
      const bool left = value(lo) > 0;
      if (left == (value(hi) > 0)) continue;
      for (int halving = 0; halving < 60; ++halving) {
        const long double mid = (lo + hi) / 2;
        ((value(mid) > 0) == left ? lo : hi) = mid;
      }
      cut.push_back(lo);
    }
  }
  cut.push_back(radius());
  long double sum = 0;
  for (std::size_t i = 0; i + 1 < cut.size(); ++i) sum += 2 * std::fabs(over(cut[i], cut[i + 1]));
  return sum;
}

long double Kernel::ripple() const {
  long double worst = 0;
  const int reach = static_cast<int>(std::ceil(radius())) + 1;
  for (int phase = 0; phase < 64; ++phase) {
    const long double x0 = (static_cast<long double>(phase) + 0.5L) / 64;
    long double sum = 0;
    for (int j = -reach; j <= reach; ++j) {
      const long double x = x0 + static_cast<long double>(j);
      if (x >= -radius() && x < radius()) sum += (*this)(x);
    }
    worst = std::max(worst, std::fabs(sum - 1));
  }
  return worst;
}

}  // namespace moire::oracle
