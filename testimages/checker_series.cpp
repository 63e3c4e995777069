// Error bounds below are sums of four parts: the remainder R, terms that are dropped where W is small, the stretches
// towards the horizon, and rounding. Rounding is bounded while it happens. u = 2^-53 is the unit roundoff.
#include "testimages/checker_series.h"

#include <algorithm>
#include <cmath>

#include "core/rounding.h"
#include "core/sum.h"
#include "curve/quadrature.h"
#include "testimages/horizon_tail.h"

namespace moire {
namespace {

using Row = LocalHomography::Row;

// Weights of at most this degree along a side are integrated by rules that are exact for them; of higher ones only as
// much as short pieces need, by what the weight is at complex points within kNearby half lengths.
constexpr int kLowDegree = 4;
constexpr double kNearby = 0.25;
// What of the stretch towards the horizon its integral leaves in doubt, for the choice of that stretch.
constexpr double kTailShare = 1e-8;
// A side that fewer lines cross is integrated between them to its end: an integral towards the horizon takes as long as
// the first number of lines, its difference to another one, in front of the horizon, longer and to less avail.
constexpr double kFewLines = 1000, kFewLinesInFront = 20000;
// What a side with more than kFewLines may come to, as a share of what may be lost to all, without being integrated.
constexpr double kNotWorth = 0.25;

Dd minor(const Row& p, const Row& q) {
  const Dd pa = p.a, pb = p.b, qa = q.a, qb = q.b;
  return pa * qb - pb * qa;
}
double minor_size(const Row& p, const Row& q) { return std::fabs(p.a * q.b) + std::fabs(p.b * q.a); }

Bounded determinant(const Row& s, const Row& j, const Row& w) {
  const Dd det = minor(s, j) * w.c + minor(j, w) * s.c + minor(w, s) * j.c;
  const auto part_error = [&](const Row& p, const Row& q, const Row& r) {
    return minor_size(p, q) * (0x1p-98 * std::fabs(r.c.hi) + r.c_error);
  };
  return {det.value(), kUnit * std::fabs(det.hi) + part_error(s, j, w) + part_error(j, w, s) + part_error(w, s, j)};
}

// A numerator, right to `error`, over the determinant.
Bounded over(Dd numerator, double error, Bounded det) {
  const double value = numerator.value() / det.value;
  return {value, 4 * kUnit * std::fabs(value) + 2 * (error + std::fabs(value) * det.error) / std::fabs(det.value)};
}

// G1 - e p at the centre of a rectangle, times the determinant: how the image point moves along the smooth family.
struct Drift {
  Bounded x, y;
};
Drift drift(const Row& jump, const Row& w, const PieceWeight& px, const PieceWeight& py, Bounded det, double scale) {
  const Vec2 centre{0.5 * (px.low + px.high), 0.5 * (py.low + py.high)};
  const double reach = std::max(std::fabs(centre.x), std::fabs(centre.y));
  const Dd j = row_at(jump, centre), d = row_at(w, centre);
  const auto part = [&](double jump_slope, double w_slope) {
    const double error = std::fabs(jump_slope) * (row_noise(w, reach) + 0x1p-98 * std::fabs(d.hi)) +
                         std::fabs(w_slope) * (row_noise(jump, reach) + 0x1p-98 * std::fabs(j.hi));
    const Bounded b = over(Dd(jump_slope) * d - Dd(w_slope) * j, error, det);
    return Bounded{b.value * scale, (b.error + kUnit * std::fabs(b.value)) * scale};
  };
  return {part(jump.b, w.b), part(-jump.a, -w.a)};
}

WeightTerms terms_of(const Row& jump, const Row& w, const PieceWeight& x, const PieceWeight& y, Bounded det, Bounded e,
                     double deepest) {
  const Drift d = drift(jump, w, x, y, det, deepest);
  return {x, y, d.x, d.y, {e.value * deepest, (e.error + kUnit * std::fabs(e.value)) * deepest}};
}

// Rules for pieces of a side: as many nodes as the terms and what matters of the weight need.
class Nodes {
 public:
  // The weight has that degree in tau and is at most `nearby` at complex points around its rectangle, in which the
  // side is `extent` half lengths long; `share` of W may be lost.
  Nodes(int degree, double nearby, double extent, double share)
      : degree_(degree), order_(degree), largest_step_(degree > kLowDegree ? 0.5 * kNearby / extent : 1) {
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
      // The ellipse's half axis is (rho + 1 / rho) / 2 times the piece's half length; it stays within kNearby.
      const double rho = 0.98 * 4 * kNearby / (step * extent_);
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

}  // namespace

CheckerSeries::CheckerSeries(const Row& smooth, const Row& jump, const Row& w, const PieceWeight& x,
                             const PieceWeight& y, double deepest)
    : smooth_(smooth),
      jump_(jump),
      w_(w),
      deepest_(deepest),
      det_(determinant(smooth, jump, w)),
      e_(over(minor(jump, w), 0x1p-98 * minor_size(jump, w), det_)),
      weight_(terms_of(jump, w, x, y, det_, e_, deepest)) {}

// Of J after that many terms, for W up to `ratio` times the deepest.
double CheckerSeries::remainder(int terms, double area, double ratio) const {
  return kEuler.sup[static_cast<std::size_t>(terms)] * area * weight_.top(terms) * std::pow(ratio, terms) *
         (1 + 0x1p-40);
}

double CheckerSeries::reach(const Polygon& polygon, double area, double goal) const {
  if (!(det_.error <= 0x1p-21 * std::fabs(det_.value))) return 0;
  double along = 0;  // sum of |C / det|
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 p = polygon[i], q = polygon[i + 1 < polygon.size() ? i + 1 : 0];
    along += std::fabs(row_at(jump_, q).hi * row_at(w_, p).hi - row_at(jump_, p).hi * row_at(w_, q).hi);
  }
  along /= std::fabs(det_.value);
  // Twice that of values: what places of lines add is alike where squares are, but stays when W becomes smaller.
  const auto rounded = [&](int m, double ratio) { return 2 * along * deepest_ * ratio * rounding(sizes(m, ratio)); };
  double best = 0;
  for (int m = 1; m <= kMaxTerms && best < 1; ++m) {
    const double whole = remainder(m, area, 1);
    if (!std::isfinite(whole)) break;
    // Also where the remainder is 0.
    double ratio = whole <= goal ? 1 : std::pow(goal / whole, 1.0 / m);
    if (!(ratio > best)) continue;
    // Rounding grows at least as W does.
    double high = ratio;
    const double lost = rounded(m, ratio);
    if (lost > goal) ratio *= goal / lost;
    for (int step = 0; step < 6 && ratio < 0.9 * high; ++step) {
      const double mid = std::sqrt(ratio * high);
      (rounded(m, mid) <= goal ? ratio : high) = mid;
    }
    best = std::max(best, ratio);
  }
  return best * deepest_;
}

void CheckerSeries::choose_terms(double area, double ratio, double goal) {
  remainder_ = HUGE_VAL;
  terms_ = 1;
  for (int m = 1; m <= kMaxTerms && remainder_ > goal; ++m) {
    const double r = remainder(m, area, ratio);
    if (!(r < remainder_)) continue;
    remainder_ = r;
    terms_ = m;
  }
  sizes_ = sizes(terms_, ratio);
  nearby_ = 0;
  for (int j = 0; j < terms_; ++j) {
    nearby_ += kEuler.sup[static_cast<std::size_t>(j + 1)] * weight_.top_nearby(j, kNearby) * std::pow(ratio, j);
  }
}

CheckerSeries::Sizes CheckerSeries::sizes(int terms, double ratio) const {
  Sizes s;
  double power = 1;
  const int nodes = std::min((terms + weight_.degree()) / 2 + 1, kMaxNodes);
  for (int j = 0; j < terms; ++j, power *= ratio) {
    const auto i = static_cast<std::size_t>(j);
    const double g = (weight_.top(j) + weight_.error(j)) * power;
    s.size += g * kEuler.sup[i + 1];
    s.slope += g * kEuler.sup[i];
    s.absolute += (8 * j + 12 + nodes) * g * kEuler.size[i + 1];
    s.error += weight_.error(j) * power * kEuler.sup[i + 1];
  }
  return s;
}

// Per unit of |C / det| times the integral of W: of W and W / deepest; in the j-th term of the polynomial by Horner's
// rule, 1.5 j + 3, its product with g_j, and j steps of Horner's rule in W / deepest, itself right to 4 u; of weights,
// products and the sum over nodes; of the g_j.
double CheckerSeries::rounding(const Sizes& s) const {
  return 3 * kUnit * (s.size + s.slope) + kUnit * s.absolute + s.error;
}

// An estimate for a side: of values as above; of places of jumps, each by 8 u of tau; of S - (k + 1/2) W, which at the
// ends of the side is as large as its squares are many.
double CheckerSeries::rounding_on(const BoardSide& side, const Sizes& s) const {
  const double w0 = std::max(side.w0.value(), 0.0), w1 = std::max(side.w1.value(), 0.0);
  if (!(w1 > 0)) return 0;
  const double per_w = 1 / std::max(w0, w1 / 8), along_s = std::fabs(side.along_s.value),
               along_j = std::fabs(side.along_j.value);
  return along_j / std::fabs(det_.value) *
         (w1 * rounding(s) + 16 * kUnit * s.size * along_j * per_w + 8 * kUnit * s.slope * along_s * per_w);
}

void CheckerSeries::lay_out(const Polygon& polygon, double area, const SeriesAim& aim) {
  aim_ = aim;
  double reach = 0;
  for (const Vec2 p : polygon) reach = std::max({reach, std::fabs(p.x), std::fabs(p.y)});
  s_noise_ = row_noise(smooth_, reach);
  j_noise_ = row_noise(jump_, reach);
  w_noise_ = row_noise(w_, reach);
  sides_.clear();
  depth_ = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 a = polygon[i], b = polygon[i + 1 < polygon.size() ? i + 1 : 0];
    sides_.emplace_back(smooth_, jump_, w_, a, b, s_noise_, j_noise_, w_noise_);
    depth_ = std::max(depth_, sides_.back().w1.value() + w_noise_);
  }
  choose_terms(area, depth_ / deepest_ * (1 + 4 * kUnit), aim.remainder);
  // Nothing else need be much better than the remainder.
  aim_.remainder = std::max(aim.remainder, remainder_ / 4);
  aim_.horizon = std::max(aim.horizon, remainder_ / 4);

  double left_out = 0, lost = 0;
  for (BoardSide& side : sides_) {
    const double w0 = std::max(side.w0.value(), 0.0), w1 = std::max(side.w1.value(), 0.0);
    const double weight = std::fabs(side.along_j.value / det_.value) * sizes_.size;
    // A side of many lines that comes to less, all in all, than what may be lost.
    const double mean = (w0 + w1) / 2 * (1 + 0x1p-20) + w_noise_;
    if (weight * mean <= kNotWorth * aim_.horizon && side.lines_beyond(w0) > kFewLines) {
      side.from = 1;
      side.left_out = mean;
      left_out += weight * mean;
      continue;
    }
    if (w_noise_ > 0x1p-54 * w1) {
      // On the horizon, or W itself is in doubt: coordinates beyond 2^45.
      side.from = 1;
      side.left_out = w1 + w_noise_;
      left_out += weight * side.left_out;
    } else if (w0 <= 0x1p-40 * w1 || side.lines_beyond(w0) > std::min(kFewLinesInFront, aim.max_pieces)) {
      // Down to where the rest does as asked, a quarter of that for each of the sides that meet the horizon.
      const double rise = w1 - side.w0.value();
      const double rate = (std::fabs(side.along_s.value) + std::fabs(side.along_j.value)) / rise;  // lines per 1 / W
      const WeightTerms::Along along(weight_, side.a, side.b, 1);
      double delta = std::sqrt(0.5 * rise * aim_.horizon / (weight * kTailShare));
      delta = std::min(delta, 1 / (1 / w1 + kFewLines / rate));
      if (along.degree() >= static_cast<int>(kTailPowers)) {
        delta = std::min(delta, w0 + kTailLength / along.extent() * rise);
      }
      delta = std::max({delta, 1 / (1 / w1 + aim.max_pieces / rate), w0 / largest_tail_start(along.degree())});
      delta = std::max(delta, 0x1p-40 * w1);
      if (delta < w1) {
        side.from = std::clamp((delta - side.w0.value()) / rise, 0.0, 1.0);
        side.left_out = side.from * (w0 + delta) / 2 * (1 + 0x1p-20) + w_noise_;
        left_out += kTailShare * weight * side.left_out;
      } else if (side.lines_beyond(w0) > aim.max_pieces) {
        // Too many lines at almost one depth.
        side.from = 1;
        side.left_out = w1 + w_noise_;
        left_out += weight * side.left_out;
      }
    }
    lost += rounding_on(side, sizes_);
  }
  estimate_ = remainder_ + left_out + lost;
}

// The sum over j of g_j r^j E_(j+1)(1/2 + t).
double CheckerSeries::sum_of_terms(double t, double r, const double* g, int terms) const {
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

Bounded CheckerSeries::integrate(const BoardSide& side) const {
  // C / det and what a unit of the integral may be off by.
  const double factor = side.sign * side.along_j.value / det_.value;
  const double factor_error =
      (side.along_j.error + std::fabs(factor) * det_.error) / std::fabs(det_.value) * (1 + 0x1p-20) +
      2 * kUnit * std::fabs(factor);
  const double largest = std::fabs(factor) + factor_error;
  const double w0 = side.w0.value(), w1 = side.w1.value(), depth = std::max(w1, 0.0) + w_noise_;

  SideLines smooth(side.s0, side.s1, side, s_noise_, w_noise_), jump(side.j0, side.j1, side, j_noise_, w_noise_);
  if (side.from >= 1) return {0, largest * sizes_.size * side.left_out};
  if (!smooth.valid() || !jump.valid()) return {0, largest * sizes_.size * depth};

  const WeightTerms::Along along(weight_, side.a, side.b, terms_);
  // Of W, what may be lost to terms that are dropped and to degrees that are.
  const double share =
      std::max(aim_.remainder / (16 * static_cast<double>(sides_.size()) * largest * depth), 0x1p-66 * nearby_);
  // The first n terms are enough up to r = enough[n].
  double enough[kMaxTerms + 1];
  double dropped = 0;
  for (int j = terms_ - 1; j >= 0; --j) {
    enough[j + 1] = dropped <= share ? HUGE_VAL : std::pow(share / dropped, 1.0 / (j + 1));
    dropped += kEuler.sup[static_cast<std::size_t>(j + 1)] * weight_.top(j);
  }
  Nodes nodes(along.degree(), nearby_, along.extent(), share);
  const bool constant = along.degree() == 0;
  double g[kMaxTerms];
  along.at(0, terms_, g);

  Sum sum;
  double sign = smooth.odd() == jump.odd() ? 1 : -1;
  double ends = 0;  // integral of |F - (k + 1/2) W| at both ends, for the rounding of values in between
  int terms = 1;
  for (double t0 = side.from; t0 < 1;) {
    const double t1 = std::min({smooth.next(), jump.next(), 1.0, t0 + nodes.largest_step()});
    if (t1 > t0) {
      const double half = (t1 - t0) / 2, mid = (t1 + t0) / 2, m0 = smooth.middle0(), m1 = smooth.middle1();
      const double ratio = (w0 + t1 * (w1 - w0)) / deepest_;
      while (terms < terms_ && ratio > enough[terms]) ++terms;
      const Rule rule = nodes.rule(t1 - t0, terms);
      double piece = 0;
      for (std::size_t i = 0; i < rule.node.size(); ++i) {
        const double t = mid + half * rule.node[i], w = w0 + t * (w1 - w0);
        if (!constant) along.at(t, terms, g);
        piece += rule.weight[i] * w * sum_of_terms((m0 + t * (m1 - m0)) / w, w / deepest_, g, terms);
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
  double error = 2 * sizes_.size * jump.jump_error() + 2 * sizes_.slope * smooth.kink_error();
  error += sizes_.slope * (6 * kUnit * (ends + 2 * depth) + length * smooth.noise());
  error += length * depth * rounding(sizes_);
  error += 2 * share * length * depth;
  error += 8 * sizes_.slope * smooth.noise();
  const double wrong_square = 12 * jump.noise() * depth * depth * sizes_.size / std::fabs(det_.value);

  Bounded rest{0, sizes_.size * side.left_out};
  if (side.left_out > 0) {
    const HorizonStretch stretch{side, along, weight_, terms_, deepest_, s_noise_, j_noise_, w_noise_};
    const Bounded tail = horizon_tail(stretch, aim_.horizon / (4 * largest));
    if (tail.error < rest.error) rest = tail;
  }
  const double value = factor * sum.value() + factor * rest.value;
  return {value, (largest * (error + rest.error) + factor_error * (std::fabs(sum.value()) + std::fabs(rest.value)) +
                  wrong_square + 4 * kUnit * (std::fabs(factor * sum.value()) + std::fabs(factor * rest.value))) *
                     (1 + 0x1p-20)};
}

Bounded CheckerSeries::integrate() const {
  if (!(det_.error <= 0x1p-21 * std::fabs(det_.value))) return {0, HUGE_VAL};
  Sum sum;
  double error = remainder_;
  for (const BoardSide& side : sides_) {
    const Bounded part = integrate(side);
    sum.add(part.value);
    error += part.error;
  }
  return {sum.value(), error + 2 * kUnit * std::fabs(sum.value())};
}

}  // namespace moire
