// u = 2^-53 throughout is the unit roundoff.
#include "testimages/series_side.h"

#include <algorithm>
#include <cmath>

#include "core/rounding.h"
#include "core/sum.h"
#include "curve/quadrature.h"
#include "testimages/side_plan.h"

namespace moire {
namespace {

// Weights of at most this degree along a side are integrated by rules that are exact for them; of higher ones only as
// much as short pieces need, by what the weight is at complex points near the side.
constexpr int kLowDegree = 4;

// Rules for pieces of a side: as many nodes as the terms and what matters of the weight need.
class Nodes {
 public:
  // The weight has that degree in tau and is at most `nearby` at complex points around its rectangle, in which the
  // side is `extent` half lengths long; `share` of W may be lost.
  Nodes(int degree, double nearby, double extent, double share)
      : degree_(degree), order_(degree), largest_step_(degree > kLowDegree ? 0.5 * kBeside / extent : 1) {
    if (degree <= kLowDegree) return;
    extent_ = extent;
    // A polynomial of degree q misses a function that is at most M in the ellipse rho by at most 2 M rho^-q / (rho - 1)
    // (Trefethen, "Approximation Theory and Approximation Practice", 2013, thm 8.2), which counts twice: in the
    // integral and in the sum. rho > 7.8 below, and share is at least 2^-66 nearby: kMost is enough.
    const double ask = 4.6 * nearby / share;
    for (std::size_t q = 0; q < kMost; ++q) needed_[q] = std::pow(ask, 1 / static_cast<double>(q + 1));
  }

  // No piece may be longer, in tau.
  double largest_step() const { return largest_step_; }

  Rule rule(double step, int terms) {
    if (degree_ > kLowDegree) {
      // The ellipse's half axis is (rho + 1 / rho) / 2 times the piece's half length; it stays within kBeside.
      const double rho = 0.98 * 4 * kBeside / (step * extent_);
      const int most = std::min(degree_, static_cast<int>(kMost));
      order_ = std::min(order_, most);
      while (order_ < most && !(rho >= needed_[static_cast<std::size_t>(order_)])) ++order_;
      while (order_ > 0 && rho >= needed_[static_cast<std::size_t>(order_ - 1)]) --order_;
    }
    return gauss_legendre(std::min((terms + order_) / 2 + 1, kMaxNodes));
  }

 private:
  static constexpr std::size_t kMost = 30;
  int degree_, order_;
  double largest_step_, extent_ = 0;
  double needed_[kMost];
};

// The sum over j of g_j r^j E_(j+1)(1/2 + t).
double sum_of_terms(double t, double r, const double* g, int terms) {
  const double tt = t * t;
  double sum = 0;
  for (int j = terms - 1; j >= 0; --j) {
    const auto& c = kEuler.coefficient[static_cast<std::size_t>(j + 1)];
    double e = 0;
    for (int i = j + 1; i >= 0; i -= 2) e = e * tt + c[static_cast<std::size_t>(i)];
    if (j % 2 == 0) e *= t;
    sum = e * g[j] + r * sum;
  }
  return sum;
}

}  // namespace

SeriesSizes::SeriesSizes(const TermBounds& top, const TermBounds& lost, int degree, int count, double ratio) {
  double power = 1;
  const int nodes = std::min((count + degree) / 2 + 1, kMaxNodes);
  for (int j = 0; j < count; ++j, power *= ratio) {
    const auto i = static_cast<std::size_t>(j);
    const double g = (top[i] + lost[i]) * power;
    size += g * kEuler.sup[i + 1];
    slope += g * kEuler.sup[i];
    absolute += (8 * j + 12 + nodes) * g * kEuler.size[i + 1];
    error += lost[i] * power * kEuler.sup[i + 1];
  }
}

// Of W and W / deepest; in the j-th term of the polynomial by Horner's rule, 1.5 j + 3, its product with g_j, and j
// steps of Horner's rule in W / deepest, itself right to 4 u; of weights, products and the sum over nodes; of the g_j.
double SeriesSizes::rounding() const { return 3 * kUnit * (size + slope) + kUnit * absolute + error; }

Bounded integrate(const BoardSide& laid_out, const SideWeight& weight, const SeriesTerms& series,
                  const SeriesNoise& noise, const SeriesAim& aim, std::size_t sides) {
  // C / det and what a unit of the integral may be off by.
  const double factor = laid_out.sign * laid_out.along_j.value / series.det.value;
  const double factor_error =
      (laid_out.along_j.error + std::fabs(factor) * series.det.error) / std::fabs(series.det.value) * (1 + 0x1p-20) +
      2 * kUnit * std::fabs(factor);
  const double largest = std::fabs(factor) + factor_error;
  const double tail_share = aim.horizon / (4 * largest);
  const SidePlan plan = plan_side(laid_out, weight, series, noise, tail_share, aim.quick);
  const BoardSide& side = plan.side;
  const double w0 = side.w0.value(), w1 = side.w1.value(), depth = std::max(w1, 0.0) + noise.w;

  SideLines smooth(side.s0, side.s1, side, noise.s, noise.w), jump(side.j0, side.j1, side, noise.j, noise.w);
  if (side.from >= 1) return {0, largest * series.sizes.size * side.left_out};
  if (!smooth.valid() || !jump.valid()) return {0, largest * series.sizes.size * depth};

  // Of W, what may be lost to terms that are dropped and to degrees that are.
  const double share =
      std::max(aim.remainder / (16 * static_cast<double>(sides) * largest * depth), 0x1p-66 * series.nearby);
  // The first n terms are enough up to r = enough[n].
  double enough[kMaxTerms + 1];
  double dropped = 0;
  for (int j = series.count - 1; j >= 0; --j) {
    enough[j + 1] = dropped <= share ? HUGE_VAL : std::pow(share / dropped, 1.0 / (j + 1));
    dropped += kEuler.sup[static_cast<std::size_t>(j + 1)] * series.top[static_cast<std::size_t>(j)];
  }
  Nodes nodes(weight.degree, series.nearby, weight.extent, share);
  const bool constant = weight.degree == 0;
  double g[kMaxTerms];
  weight.at(0, series.count, g);

  Sum sum;
  double sign = smooth.odd() == jump.odd() ? 1 : -1;
  double ends = 0;  // integral of |F - (k + 1/2) W| at both ends, for the rounding of values in between
  int terms = 1;
  for (double t0 = side.from; t0 < 1;) {
    const double t1 = std::min({smooth.next(), jump.next(), 1.0, t0 + nodes.largest_step()});
    if (t1 > t0) {
      const double half = (t1 - t0) / 2, mid = (t1 + t0) / 2, m0 = smooth.middle0(), m1 = smooth.middle1();
      const double ratio = (w0 + t1 * (w1 - w0)) / series.deepest;
      while (terms < series.count && ratio > enough[terms]) ++terms;
      const Rule rule = nodes.rule(t1 - t0, terms);
      double piece = 0;
      for (std::size_t i = 0; i < rule.node.size(); ++i) {
        const double t = mid + half * rule.node[i], w = w0 + t * (w1 - w0);
        if (!constant) weight.at(t, terms, g);
        piece += rule.weight[i] * w * sum_of_terms((m0 + t * (m1 - m0)) / w, w / series.deepest, g, terms);
      }
      sum.add(sign * half * piece);
      ends += 2 * half * (std::fabs(m0) + std::fabs(m1));
      t0 = t1;
    }
    if (smooth.next() <= t0) smooth.advance(), sign = -sign;
    if (jump.next() <= t0) jump.advance(), sign = -sign;
  }
  // Per unit of C / det. In this order: places of the jumps and of the kinks (the wrong polynomial differs from E_1 by
  // twice the distance to the line); values of S - (k + 1/2) W; see rounding(); what is dropped; first and last square.
  const double length = 1 - side.from;
  double error = 2 * series.sizes.size * jump.jump_error() + 2 * series.sizes.slope * smooth.kink_error();
  error += series.sizes.slope * (6 * kUnit * (ends + 2 * depth) + length * smooth.noise());
  error += length * depth * series.sizes.rounding();
  error += 2 * share * length * depth;
  error += 8 * series.sizes.slope * smooth.noise();
  const double wrong_square = 12 * jump.noise() * depth * depth * series.sizes.size / std::fabs(series.det.value);

  Bounded rest{0, series.sizes.size * side.left_out};
  if (side.left_out > 0) {
    const Bounded tail = integrate_rest(plan, weight, series, noise, tail_share);
    if (tail.error < rest.error) rest = tail;
  }
  const double value = factor * sum.value() + factor * rest.value;
  return {value, (largest * (error + rest.error) + factor_error * (std::fabs(sum.value()) + std::fabs(rest.value)) +
                  wrong_square + 4 * kUnit * (std::fabs(factor * sum.value()) + std::fabs(factor * rest.value))) *
                     (1 + 0x1p-20)};
}

}  // namespace moire
