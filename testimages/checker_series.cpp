// Error bounds below are sums of three parts: the remainder R, the stretches left out towards the horizon, and
// rounding. Rounding is bounded while it happens. u = 2^-53 is the unit roundoff; values at the ends of a side come
// from double-double and are right to a few u of themselves, however large u and v are there.
#include "testimages/checker_series.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "core/rounding.h"
#include "core/sum.h"
#include "curve/quadrature.h"

namespace moire {
namespace {

constexpr int kMaxTerms = 16;
// Beyond so many squares from the origin the ends of a side, right to 2^-98 or so, no longer tell single squares apart.
constexpr double kFarthest = 0x1p40;

// E_j(1/2 + t) for |t| <= 1/2: the coefficients of t^i, z^j in e^(tz) sech(z/2), which are Euler numbers over
// factorials.
struct EulerPolynomials {
  std::array<std::array<double, kMaxTerms + 1>, kMaxTerms + 1> coefficient{};
  std::array<double, kMaxTerms + 1> sup{};   // of |E_j|: in the middle for even j, at the ends for odd j
  std::array<double, kMaxTerms + 1> size{};  // sum of |coefficient| 2^-i

  constexpr EulerPolynomials() {
    constexpr double kEuler[] = {1, -1, 5, -61, 1385, -50521, 2702765, -199360981, 19391512145};
    std::array<double, kMaxTerms + 1> factorial{1};
    for (std::size_t i = 1; i <= kMaxTerms; ++i) factorial[i] = factorial[i - 1] * static_cast<double>(i);
    for (std::size_t j = 0; j <= kMaxTerms; ++j) {
      double power = 1, end = 0;
      for (std::size_t i = 0; i <= j; ++i, power /= 2) {
        if ((j - i) % 2 != 0) continue;
        // Exact but for this division: factorials up to 16! and powers of two are doubles.
        double two = 1;
        for (std::size_t n = i; n < j; ++n) two *= 2;
        coefficient[j][i] = kEuler[(j - i) / 2] / (two * factorial[j - i] * factorial[i]);
        end += coefficient[j][i] * power;
        size[j] += (coefficient[j][i] < 0 ? -coefficient[j][i] : coefficient[j][i]) * power;
      }
      const double extreme = j % 2 == 0 ? coefficient[j][0] : end;
      sup[j] = (extreme < 0 ? -extreme : extreme) * (1 + 0x1p-40);
    }
  }
};
constexpr EulerPolynomials kEuler;

// A value right to `error`, both absolute.
struct Bounded {
  double value = 0, error = 0;
};

using Row = LocalHomography::Row;

// A row's value at a point, right to row_error().
Dd at(const Row& r, Vec2 p) { return two_prod(r.a, p.x) + two_prod(r.b, p.y) + r.c; }
double row_error(const Row& r, double reach) {
  return r.c_error + 0x1p-100 * ((std::fabs(r.a) + std::fabs(r.b)) * reach + std::fabs(r.c.hi));
}

// a b - c d.
Bounded cross(Dd a, Dd b, Dd c, Dd d) {
  return {(a * b - c * d).value(), 0x1p-98 * (std::fabs(a.hi * b.hi) + std::fabs(c.hi * d.hi))};
}

// A polygon's side, from the end with smaller W to the other; sign is -1 where that is against the polygon's order.
// s and j are the rows of the smooth family, that of E_(j+1), and of the family that jumps, that of s().
struct Side {
  Dd s0, s1, j0, j1, w0, w1;
  double sign = 1;
  Bounded along_s, along_j;  // S'W - SW' and J'W - JW', the latter called C above
  double from = 0;           // tau from which the side is integrated
  double left_out = 0;       // integral of W over what is not
};

// The lines of one family that cross a side, in order of tau.
//
// On the line number k, F - k W = L0 (1 - tau) + L1 tau = 0. L0 is counted from the square at the start and L1 from
// that at the end, so that both are sums of terms of one sign, up to one square: |error of L0| <= 3u (|L0| + |W0|) +
// noise.
class Lines {
 public:
  Lines(Dd f0, Dd f1, const Side& side, double f_error, double w_error) : w0_(side.w0.value()), w1_(side.w1.value()) {
    const Dd t = side.from;
    const double first = square(f0 + t * (f1 - f0), side.w0 + t * (side.w1 - side.w0)), last = square(f1, side.w1);
    if (!(std::fabs(first) < kFarthest && std::fabs(last) < kFarthest)) return;
    valid_ = true;
    first_ = first;
    last_ = last;
    current_ = first;
    step_ = last < first ? -1 : 1;
    left_ = std::fabs(last - first);
    base0_ = (f0 - Dd(first) * side.w0).value();
    base1_ = (f1 - Dd(last) * side.w1).value();
    noise_ = 4 * (f_error + (std::max(std::fabs(first), std::fabs(last)) + 2) * w_error) +
             0x1p-98 * (std::fabs(f0.hi) + std::fabs(f1.hi));
    at_ = side.from;
    find();
  }

  bool valid() const { return valid_; }
  // Of the next line; above 1: there is none.
  double next() const { return next_; }
  void advance() {
    current_ += step_;
    --left_;
    at_ = std::min(next_, 1.0);
    find();
  }
  bool odd() const { return current_ != 2 * std::floor(current_ / 2); }
  // F - (k + 1/2) W at the ends, k the current square's number.
  double middle0() const { return base0_ + (first_ - current_ - 0.5) * w0_; }
  double middle1() const { return base1_ + (last_ - current_ - 0.5) * w1_; }
  // Of the values at the ends, beyond their own rounding.
  double noise() const { return noise_; }
  // Sums over the lines passed, d being the error of their tau: of W d, and of |F - k W| where they truly are times d.
  double jump_error() const { return jump_error_; }
  double kink_error() const { return kink_error_; }

 private:
  // floor(f / w), right up to 2^-98 or so of f.
  static double square(Dd f, Dd w) {
    double k = std::floor(f.hi / w.hi);
    const Dd rest = f - Dd(k) * w;
    if (rest.hi < 0) return k - 1;
    return (rest - w).hi >= 0 ? k + 1 : k;
  }

  void find() {
    next_ = 2;
    if (!(left_ > 0)) return;
    const double k = step_ > 0 ? current_ + 1 : current_;
    const double l0 = base0_ + (first_ - k) * w0_, l1 = base1_ + (last_ - k) * w1_, slope = std::fabs(l0 - l1);
    // Rounding may put the line beyond an end or before its predecessor.
    next_ = slope > 0 ? std::clamp(l0 / (l0 - l1), at_, 1.0) : at_;
    const double depth = std::fabs(w0_) + next_ * w1_;
    const double miss = 8 * kUnit * next_ * slope + 3 * kUnit * depth + noise_;
    const double d = slope > 0 ? std::min(miss / slope, 1.0) : 1;
    jump_error_ += depth * d;
    kink_error_ += miss * d;
  }

  double w0_, w1_, first_ = 0, last_ = 0, current_ = 0, step_ = 1, left_ = 0, base0_ = 0, base1_ = 0, noise_ = 0;
  double at_ = 0, next_ = 2, jump_error_ = 0, kink_error_ = 0;
  bool valid_ = false;
};

// The series in one of its two forms.
class Series {
 public:
  // By parts along `smooth`; `jump` is the other row.
  Series(const Row& smooth, const Row& jump, const Row& w, const Polygon& polygon, double area, double max_pieces);

  // An estimate of the bound on J, good enough to choose.
  double estimate() const { return estimate_; }
  // J and its bound.
  Bounded integrate() const;

 private:
  void choose_terms(double area, double goal);
  Bounded integrate(const Side& side) const;
  double sum_of_terms(double t, double r) const;

  std::vector<Side> sides_;
  double s_error_, j_error_, w_error_;
  Bounded det_, e_;
  double deepest_ = 0;  // largest W
  int terms_ = 1;       // m
  double remainder_ = 0;
  // Bounds for |t| <= 1/2 and W up to the deepest, on sum over j of c_j (e W)^j times: |E_(j+1)|, |E_j| (its slope in
  // t), the absolute terms of E_(j+1), and the slope in e W.
  double size_ = 0, slope_ = 0, absolute_ = 0, slope_r_ = 0;
  double estimate_ = 0;
};

Series::Series(const Row& smooth, const Row& jump, const Row& w, const Polygon& polygon, double area,
               double max_pieces) {
  double reach = 0;
  for (const Vec2 p : polygon) reach = std::max({reach, std::fabs(p.x), std::fabs(p.y)});
  s_error_ = row_error(smooth, reach);
  j_error_ = row_error(jump, reach);
  w_error_ = row_error(w, reach);

  const auto minor = [](const Row& p, const Row& q) {
    const Dd pa = p.a, pb = p.b, qa = q.a, qb = q.b;
    return pa * qb - pb * qa;
  };
  const auto minor_size = [](const Row& p, const Row& q) { return std::fabs(p.a * q.b) + std::fabs(p.b * q.a); };
  const Dd det = minor(smooth, jump) * w.c + minor(jump, w) * smooth.c + minor(w, smooth) * jump.c;
  const auto part_error = [&](const Row& p, const Row& q, const Row& r) {
    return minor_size(p, q) * (0x1p-98 * std::fabs(r.c.hi) + r.c_error);
  };
  det_ = {det.value(), kUnit * std::fabs(det.hi) + part_error(smooth, jump, w) + part_error(jump, w, smooth) +
                           part_error(w, smooth, jump)};
  e_.value = (minor(jump, w) / det).value();
  e_.error = 4 * kUnit * std::fabs(e_.value) +
             2 * (0x1p-98 * minor_size(jump, w) + std::fabs(e_.value) * det_.error) / std::fabs(det_.value);

  double left_out = 0, rounding = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    Vec2 a = polygon[i], b = polygon[i + 1 < polygon.size() ? i + 1 : 0];
    Side side;
    if (at(w, a).hi > at(w, b).hi) {
      std::swap(a, b);
      side.sign = -1;
    }
    side.s0 = at(smooth, a), side.j0 = at(jump, a), side.w0 = at(w, a);
    side.s1 = at(smooth, b), side.j1 = at(jump, b), side.w1 = at(w, b);
    side.along_s = cross(side.s1, side.w0, side.s0, side.w1);
    side.along_j = cross(side.j1, side.w0, side.j0, side.w1);
    const auto add_row_errors = [&](Bounded& along, double row_error, double largest) {
      along.error += 2 * (row_error * std::fabs(side.w1.hi) + w_error_ * largest);
    };
    add_row_errors(side.along_s, s_error_, std::max(std::fabs(side.s0.hi), std::fabs(side.s1.hi)));
    add_row_errors(side.along_j, j_error_, std::max(std::fabs(side.j0.hi), std::fabs(side.j1.hi)));

    const double w0 = std::max(side.w0.value(), 0.0), w1 = std::max(side.w1.value(), 0.0);
    deepest_ = std::max(deepest_, w1 + w_error_);
    // Between W = a and W = w1 the side crosses (|S'W - SW'| + |J'W - JW'|) (1/a - 1/w1) / (w1 - w0) lines.
    const double along = std::fabs(side.along_s.value) + std::fabs(side.along_j.value);
    if (w_error_ > 0x1p-54 * w1) {
      // On the horizon, or W itself is in doubt: coordinates beyond 2^45.
      side.from = 1;
      side.left_out = w1 + w_error_;
    } else if (w0 <= 0 || along > max_pieces * w0 * w1) {
      const double rise = w1 - side.w0.value();
      const double delta = std::max(1 / (1 / w1 + max_pieces * rise / along), 0x1p-40 * w1);
      if (!(delta > w0)) {
        side.from = 0;
      } else {
        side.from = delta < w1 ? std::clamp((delta - side.w0.value()) / rise, 0.0, 1.0) : 1;
        side.left_out = side.from * (w0 + delta) / 2 * (1 + 0x1p-20) + w_error_;
      }
    }
    const double weight = std::fabs(side.along_j.value / det_.value);
    left_out += weight * side.left_out / 2;
    if (w1 > 0) rounding += 4 * kUnit * weight * std::fabs(side.along_j.value) / std::max(w0, w1 / 8);
    sides_.push_back(side);
  }
  choose_terms(area, std::max(0x1p-50 * area, left_out / 64));
  estimate_ = remainder_ + left_out + rounding;
}

void Series::choose_terms(double area, double goal) {
  const double r = (std::fabs(e_.value) + e_.error) * deepest_ * (1 + 4 * kUnit);
  remainder_ = HUGE_VAL;
  double c = 1, power = 1;  // c_m and r^m
  for (int m = 1; m <= kMaxTerms && remainder_ > goal; ++m) {
    c *= m + 2;
    power *= r;
    const double remainder = kEuler.sup[static_cast<std::size_t>(m)] * c * power * area * (1 + 0x1p-40);
    if (!(remainder < remainder_)) continue;
    remainder_ = remainder;
    terms_ = m;
  }
  c = power = 1;
  double before = 0;  // r^(j-1)
  for (std::size_t j = 0; j < static_cast<std::size_t>(terms_); ++j) {
    size_ += c * power * kEuler.sup[j + 1];
    slope_ += c * power * kEuler.sup[j];
    absolute_ += c * power * kEuler.size[j + 1];
    slope_r_ += static_cast<double>(j) * c * before * kEuler.sup[j + 1];
    c *= static_cast<double>(j + 3);
    before = power;
    power *= r;
  }
}

// The sum over j < m of c_j r^j E_(j+1)(1/2 + t).
double Series::sum_of_terms(double t, double r) const {
  const double tt = t * t;
  double sum = 0;
  for (int j = terms_ - 1; j >= 0; --j) {
    const auto& c = kEuler.coefficient[static_cast<std::size_t>(j + 1)];
    double e = 0;
    for (int i = j + 1; i >= 0; i -= 2) e = e * tt + c[static_cast<std::size_t>(i)];
    if (j % 2 == 0) e *= t;
    sum = e + (j + 3) * r * sum;
  }
  return sum;
}

Bounded Series::integrate(const Side& side) const {
  // C / det and what a unit of the integral may be off by.
  const double factor = side.sign * side.along_j.value / det_.value;
  const double factor_error =
      (side.along_j.error + std::fabs(factor) * det_.error) / std::fabs(det_.value) * (1 + 0x1p-20) +
      2 * kUnit * std::fabs(factor);
  const double largest = std::fabs(factor) + factor_error;
  const double w0 = side.w0.value(), w1 = side.w1.value(), depth = std::max(w1, 0.0) + w_error_;

  Lines smooth(side.s0, side.s1, side, s_error_, w_error_), jump(side.j0, side.j1, side, j_error_, w_error_);
  if (side.from >= 1 || !smooth.valid() || !jump.valid()) return {0, largest * size_ * depth};

  const Rule rule = gauss_legendre(terms_ / 2 + 1);
  Sum sum;
  double sign = smooth.odd() == jump.odd() ? 1 : -1;
  double ends = 0;  // integral of |F - (k + 1/2) W| at both ends, for the rounding of values in between
  for (double t0 = side.from; t0 < 1;) {
    const double t1 = std::min({smooth.next(), jump.next(), 1.0});
    if (t1 > t0) {
      const double half = (t1 - t0) / 2, mid = (t1 + t0) / 2, m0 = smooth.middle0(), m1 = smooth.middle1();
      double piece = 0;
      for (std::size_t i = 0; i < rule.node.size(); ++i) {
        const double t = mid + half * rule.node[i], w = w0 + t * (w1 - w0);
        piece += rule.weight[i] * w * sum_of_terms((m0 + t * (m1 - m0)) / w, e_.value * w);
      }
      sum.add(sign * half * piece);
      ends += 2 * half * (std::fabs(m0) + std::fabs(m1));
      t0 = t1;
    }
    if (smooth.next() <= t0) smooth.advance(), sign = -sign;
    if (jump.next() <= t0) jump.advance(), sign = -sign;
  }
  // Per unit of C / det. In this order: places of the jumps and of the kinks (the wrong polynomial differs from E_1 by
  // twice the distance to the line); values of S - (k + 1/2) W; of W, e W and the polynomials; first and last square.
  const double length = 1 - side.from;
  double error = 2 * size_ * jump.jump_error() + 2 * slope_ * smooth.kink_error();
  error += slope_ * (8 * kUnit * (ends + 2 * depth) + length * smooth.noise());
  error += length * depth *
           (3 * kUnit * (size_ + slope_) + slope_r_ * (e_.error + 4 * kUnit * std::fabs(e_.value)) * depth +
            (4 * terms_ + 16) * kUnit * absolute_);
  error += 8 * slope_ * smooth.noise();
  const double wrong_square = 12 * jump.noise() * depth * depth * size_ / std::fabs(det_.value);
  const double value = factor * sum.value();
  return {value, (largest * (error + size_ * side.left_out) + factor_error * std::fabs(sum.value()) + wrong_square +
                  2 * kUnit * std::fabs(value)) *
                     (1 + 0x1p-20)};
}

Bounded Series::integrate() const {
  if (!(det_.error <= 0x1p-21 * std::fabs(det_.value))) return {0, HUGE_VAL};
  Sum sum;
  double error = remainder_;
  for (const Side& side : sides_) {
    const Bounded part = integrate(side);
    sum.add(part.value);
    error += part.error;
  }
  return {sum.value(), error + 2 * kUnit * std::fabs(sum.value())};
}

}  // namespace

BoxIntegral board_series(const LocalHomography& local, const Polygon& polygon, double max_pieces) {
  double area = 0, terms = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 a = polygon[i], b = polygon[i + 1 < polygon.size() ? i + 1 : 0];
    area += 0.5 * (a.x * b.y - b.x * a.y);
    terms += 0.5 * (std::fabs(a.x * b.y) + std::fabs(b.x * a.y));
  }
  const double area_error = 16 * kUnit * terms;
  if (!(area > 0)) return {0, area_error};
  const double whole = area + area_error;
  const Series along_u(local.u, local.v, local.w, polygon, whole, max_pieces),
      along_v(local.v, local.u, local.w, polygon, whole, max_pieces);
  const Bounded j = (along_u.estimate() <= along_v.estimate() ? along_u : along_v).integrate();
  // Known beforehand: between nothing and all.
  if (!(j.error < whole)) return {area / 2, whole / 2 + area_error};
  return {(area + j.value) / 2, (area_error + j.error) / 2 + kUnit * whole};
}

}  // namespace moire
