// u = 2^-53 throughout is the unit roundoff.
#include "testimages/series_side.h"

#include <algorithm>
#include <cmath>

#include "core/rounding.h"
#include "core/sum.h"
#include "curve/quadrature.h"
#include "testimages/horizon_tail.h"

namespace moire {
namespace {

// Weights of at most this degree along a side are integrated by rules that are exact for them; of higher ones only as
// much as short pieces need, by what the weight is at complex points near the side.
constexpr int kLowDegree = 4;
// What of the stretch towards the horizon its integral leaves in doubt, for the choice of that stretch.
constexpr double kTailShare = 1e-8;
// A side that fewer lines cross is integrated between them to its end: an integral towards the horizon takes as long as
// the first number of lines, its difference to another one, in front of the horizon, longer and to less avail.
constexpr double kFewLines = 1000, kFewLinesInFront = 20000;
// Of a side's largest W, from where on its noise puts its lines in doubt: on the horizon, or coordinates beyond 2^45.
constexpr double kWInDoubt = 0x1p-54;
// Into stretches of this length, in half lengths of the weight, the part that is left to integrals towards the horizon
// is cut where one polynomial would miss too much. Shorter ones are known better, but each takes up to some
// milliseconds.
constexpr double kStretch = 0.5;
// What the integrals over short stretches may lose, as a share of what they leave in doubt anyway.
constexpr double kShareOfDoubt = 0.25;
// What a side with more than kFewLines may come to, as a share of what may be lost to all, without being integrated.
constexpr double kNotWorth = 0.25;

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

// An estimate for a side: of values as above; of places of jumps, each by 8 u of tau; of S - (k + 1/2) W, which at the
// ends of the side is as large as its squares are many.
double rounding_on(const BoardSide& side, const SeriesTerms& terms) {
  const SeriesSizes& s = terms.sizes;
  const double w0 = std::max(side.w0.value(), 0.0), w1 = std::max(side.w1.value(), 0.0);
  if (!(w1 > 0)) return 0;
  const double per_w = 1 / std::max(w0, w1 / 8), along_s = std::fabs(side.along_s.value),
               along_j = std::fabs(side.along_j.value);
  return along_j / std::fabs(terms.det.value) *
         (w1 * s.rounding() + 16 * kUnit * s.size * along_j * per_w + 8 * kUnit * s.slope * along_s * per_w);
}

// Lines per unit of 1 / W.
double line_rate(const BoardSide& side) {
  return (std::fabs(side.along_s.value) + std::fabs(side.along_j.value)) / (side.w1.value() - side.w0.value());
}

// Leaves out W from side.w0, or 0, to `delta`, a W between side.w0 and side.w1.
void leave_out(BoardSide& side, double delta, const SeriesNoise& noise) {
  side.from = std::clamp((delta - side.w0.value()) / (side.w1.value() - side.w0.value()), 0.0, 1.0);
  side.left_out = side.from * (std::max(side.w0.value(), 0.0) + delta) / 2 * (1 + 0x1p-20) + noise.w;
}

// What of a side is left to integrals towards the horizon, 0 <= tau <= side.from, cut into equal stretches.
class Tail {
 public:
  Tail(const BoardSide& side, const SideWeight& weight, const SeriesTerms& terms, const SeriesNoise& noise,
       double count)
      : side_(side), weight_(weight), terms_(terms), noise_(noise), count_(count) {}

  // About what the integrals leave in doubt.
  double doubt() const {
    if (!(side_.left_out > 0)) return 0;
    double sum = 0;
    for (double i = 0; i < count_; ++i) sum += tail_doubt(stretch(i));
    return std::min(sum, terms_.sizes.size * side_.left_out);
  }
  Bounded integrate(double goal) const {
    if (count_ == 1) return horizon_tail(stretch(0), goal);
    const double each = std::max(goal, kShareOfDoubt * doubt()) / count_;
    Sum sum;
    double error = 0;
    for (double i = 0; i < count_; ++i) {
      const Bounded part = horizon_tail(stretch(i), each);
      sum.add(part.value);
      error += part.error;
    }
    return {sum.value(), error * (1 + 0x1p-40) + 2 * kUnit * std::fabs(sum.value())};
  }

 private:
  HorizonStretch stretch(double i) const {
    if (count_ == 1) return {side_, weight_, terms_, noise_, 0, side_.from, side_.left_out};
    const auto w_at = [&](double tau) {
      return std::max(side_.w0.value() + tau * (side_.w1.value() - side_.w0.value()), 0.0);
    };
    const double start = side_.from * (i / count_), end = side_.from * ((i + 1) / count_);
    const double integral_of_w = (end - start) * (w_at(start) + w_at(end)) / 2 * (1 + 0x1p-20) + noise_.w;
    return {side_, weight_, terms_, noise_, start, end, integral_of_w};
  }

  const BoardSide& side_;
  const SideWeight& weight_;
  const SeriesTerms& terms_;
  const SeriesNoise& noise_;
  double count_;
};

// Lines that a side is integrated between.
double lines_of(const BoardSide& side) {
  if (side.from >= 1) return 0;
  const double w0 = side.w0.value(), w1 = side.w1.value(), from = w0 + side.from * (w1 - w0);
  return w1 > 0 ? side.lines_beyond(std::max(from, 0x1p-40 * w1)) : 0;
}

// What of a side is integrated between lines, which is in side.from, and into how many stretches the rest is cut.
struct Plan {
  BoardSide side;
  double stretches, doubt;  // the latter without C / det
};

// The ways to integrate a side that has been laid out.
class Plans {
 public:
  Plans(const BoardSide& side, const SideWeight& weight, const SeriesTerms& terms, const SeriesNoise& noise)
      : side_(side), weight_(weight), terms_(terms), noise_(noise) {}

  Plan laid_out() const { return plan(side_, 1); }

  // As laid out, if that leaves no more than `share` in doubt; else in short stretches from the first lines on, if that
  // is no worse; else in short stretches as far as laid out, if that is better.
  Plan within(double share) const {
    Plan as = laid_out();
    if (settled() || as.doubt <= share) return as;
    Plan few = few_lines();
    if (few.doubt <= std::max(share, as.doubt)) return few;
    Plan cut = plan(side_, short_stretches(side_));
    return cut.doubt < as.doubt ? cut : as;
  }

  // As within(), but never between many lines.
  Plan quick(double share) const {
    if (settled()) return laid_out();
    Plan as = laid_out();
    return as.doubt <= share && lines_of(side_) <= kFewLinesInFront ? as : few_lines();
  }

 private:
  // There is nothing to choose: the weight is a polynomial in W for all lengths, W itself is in doubt, or constant.
  bool settled() const {
    const double rise = side_.w1.value() - side_.w0.value();
    return weight_.degree < static_cast<int>(kTailPowers) || noise_.w > kWInDoubt * side_.w1.value() ||
           !(rise > 4 * noise_.w);
  }
  double short_stretches(const BoardSide& side) const {
    return std::max(std::ceil(side.from * weight_.extent / kStretch), 1.0);
  }
  Plan few_lines() const {
    BoardSide few = side_;
    leave_out(few, 1 / (1 / side_.w1.value() + kFewLines / line_rate(side_)), noise_);
    return plan(few, short_stretches(few));
  }
  Plan plan(const BoardSide& side, double stretches) const {
    return {side, stretches, Tail(side, weight_, terms_, noise_, stretches).doubt()};
  }

  const BoardSide& side_;
  const SideWeight& weight_;
  const SeriesTerms& terms_;
  const SeriesNoise& noise_;
};

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

SideEstimate lay_out(BoardSide& side, int degree, double extent, const SeriesTerms& terms, const SeriesNoise& noise,
                     const SeriesAim& aim) {
  SideEstimate out;
  const double w0 = std::max(side.w0.value(), 0.0), w1 = std::max(side.w1.value(), 0.0);
  const double weight = std::fabs(side.along_j.value / terms.det.value) * terms.sizes.size;
  // A side of many lines that comes to less, all in all, than what may be lost.
  const double mean = (w0 + w1) / 2 * (1 + 0x1p-20) + noise.w;
  if (weight * mean <= kNotWorth * aim.horizon && side.lines_beyond(w0) > kFewLines) {
    side.from = 1;
    side.left_out = mean;
    out.left_out += weight * mean;
    return out;
  }
  if (noise.w > kWInDoubt * w1) {
    side.from = 1;
    side.left_out = w1 + noise.w;
    out.left_out += weight * side.left_out;
  } else if (w0 <= 0x1p-40 * w1 || side.lines_beyond(w0) > std::min(kFewLinesInFront, aim.max_pieces)) {
    // Down to where the rest does as asked, a quarter of that for each of the sides that meet the horizon.
    const double rise = w1 - side.w0.value(), rate = line_rate(side);
    double delta = std::sqrt(0.5 * rise * aim.horizon / (weight * kTailShare));
    delta = std::min(delta, 1 / (1 / w1 + kFewLines / rate));
    if (degree >= static_cast<int>(kTailPowers)) {
      delta = std::min(delta, w0 + kTailLength / extent * rise);
    }
    delta = std::max({delta, 1 / (1 / w1 + aim.max_pieces / rate), w0 / largest_tail_start(degree)});
    delta = std::max(delta, 0x1p-40 * w1);
    if (delta < w1) {
      leave_out(side, delta, noise);
      out.left_out += kTailShare * weight * side.left_out;
    } else if (side.lines_beyond(w0) > aim.max_pieces) {
      // Too many lines at almost one depth.
      side.from = 1;
      side.left_out = w1 + noise.w;
      out.left_out += weight * side.left_out;
    }
  }
  out.lost = rounding_on(side, terms);
  return out;
}

void SeriesOutlook::add(const SeriesOutlook& other) {
  doubt += other.doubt;
  lines += other.lines;
  quick += other.quick;
  laid_out += other.laid_out;
}

SeriesOutlook outlook(const BoardSide& side, const SideWeight& weight, const SeriesTerms& terms,
                      const SeriesNoise& noise, const SeriesAim& aim) {
  const double factor = std::fabs(side.along_j.value / terms.det.value), share = aim.horizon / (4 * factor);
  const Plans plans(side, weight, terms, noise);
  const Plan plan = plans.within(share);
  return {factor * plan.doubt, lines_of(plan.side), factor * plans.quick(share).doubt, factor * plans.laid_out().doubt};
}

Bounded integrate(const BoardSide& laid_out, const SideWeight& weight, const SeriesTerms& series,
                  const SeriesNoise& noise, const SeriesAim& aim, std::size_t sides) {
  // C / det and what a unit of the integral may be off by.
  const double factor = laid_out.sign * laid_out.along_j.value / series.det.value;
  const double factor_error =
      (laid_out.along_j.error + std::fabs(factor) * series.det.error) / std::fabs(series.det.value) * (1 + 0x1p-20) +
      2 * kUnit * std::fabs(factor);
  const double largest = std::fabs(factor) + factor_error;
  const double tail_share = aim.horizon / (4 * largest);
  const Plans plans(laid_out, weight, series, noise);
  const Plan plan = aim.quick ? plans.quick(tail_share) : plans.within(tail_share);
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
    const Bounded tail = Tail(side, weight, series, noise, plan.stretches).integrate(tail_share);
    if (tail.error < rest.error) rest = tail;
  }
  const double value = factor * sum.value() + factor * rest.value;
  return {value, (largest * (error + rest.error) + factor_error * (std::fabs(sum.value()) + std::fabs(rest.value)) +
                  wrong_square + 4 * kUnit * (std::fabs(factor * sum.value()) + std::fabs(factor * rest.value))) *
                     (1 + 0x1p-20)};
}

}  // namespace moire
