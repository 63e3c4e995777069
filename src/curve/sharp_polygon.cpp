// u = 2^-53, h the half width of the square around the window, |l| = |a| + |b| of a line. Lines that cross the window
// have |c| <= |l| h.
//
// Where the lines l and m meet well, |det| >= 2^-12 |l| |m|: the starting point has residuals of at most 24 u |l| h and
// 24 u |m| h (6 u of the terms for each value, twice, and 4 u h for the point), so that it moves by less than
// 48 u 2^12 h = 2^-35 h, known to 4 u 2^12 (of the determinant) + 8 u of itself; the residuals themselves are right to
// 2^-100 of their terms. So vertices are right to 2^-74 h + 2^-86 h < 2^-73 h. Where the lines are nearly parallel the
// vertex is interpolated in double-double, along a side that is itself right to 2^-73 h, at values right to 2^-98 of
// their terms: within 2^-72 h of both lines.
//
// A vertex whose value is within 2^-70 |l| h of zero even so counts as on the line: it is within 2^-69 h of it. That is
// more than vertices miss their places by, so that the signs around a polygon change twice at most, as around an
// exactly convex one, and a cut adds at most one vertex to either part.
#include "curve/sharp_polygon.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "core/rounding.h"

namespace moire {

SharpPolygon& SharpPolygon::operator=(const SharpPolygon& other) {
  std::copy_n(other.stored_.begin(), other.size_, stored_.begin());
  size_ = other.size_;
  return *this;
}

void SharpPolygon::push_back(const SharpVertex& v) {
  assert(size_ < kCapacity);
  stored_[size_++] = {v.at.x, v.at.y, v.rest.x, v.rest.y, v.side};
}

Dd SharpClipper::Line::exactly(const SharpVertex& v) const {
  return Dd(a, a_rest) * two_sum(v.at.x, v.rest.x) + Dd(b, b_rest) * two_sum(v.at.y, v.rest.y) + Dd(c, c_rest);
}

// The line's value at p. The large terms cancel without error; what is added plainly is u of them.
double SharpClipper::Line::residual(Vec2 p) const {
  const Dd x = two_prod(a, p.x), y = two_prod(b, p.y);
  const Dd first = two_sum(x.hi, y.hi), second = two_sum(first.hi, c);
  return second.hi + ((second.lo + first.lo) + (x.lo + y.lo) + (a_rest * p.x + b_rest * p.y + c_rest));
}

SharpClipper::SharpClipper(double half_width)
    : SharpClipper(Rect{{-half_width, -half_width}, {half_width, half_width}}) {}

SharpClipper::SharpClipper(const Rect& r)
    : window_(r), half_width_(std::max(std::max(-r.lo.x, r.hi.x), std::max(-r.lo.y, r.hi.y))) {
  // Top, right, bottom, left, as window() walks.
  lines_[0] = {0, 1, -r.lo.y, 0, 0, 0, 0, 1};
  lines_[1] = {-1, 0, r.hi.x, 0, 0, 0, 0, 1};
  lines_[2] = {0, -1, r.hi.y, 0, 0, 0, 0, 1};
  lines_[3] = {1, 0, -r.lo.x, 0, 0, 0, 0, 1};
}

SharpPolygon SharpClipper::window() const {
  const auto& [lo, hi] = window_;
  const Vec2 corners[kWindow] = {lo, {hi.x, lo.y}, hi, {lo.x, hi.y}};
  SharpPolygon square;
  for (int i = 0; i < kWindow; ++i) square.push_back({corners[i], {}, i});
  return square;
}

void SharpClipper::set_line(int slot, const SharpLine& l) {
  const double norm = std::fabs(l.a.hi) + std::fabs(l.b.hi);
  // Away from underflow, by a power of two; that a line of this norm loses nothing else is up to its maker.
  const double s = norm < 0x1p-400 ? 0x1p400 : 1;
  lines_[static_cast<std::size_t>(slot)] = {s * l.a.hi, s * l.b.hi, s * l.c.hi,  s * l.a.lo,
                                            s * l.b.lo, s * l.c.lo, s * l.error, s * norm};
}

SharpVertex SharpClipper::meet(const SharpVertex& a, double value_a, const SharpVertex& b, double value_b,
                               const Line& l) const {
  const Line& m = lines_[static_cast<std::size_t>(a.side)];
  const double det = l.a * m.b - l.b * m.a;
  if (std::fabs(det) >= 0x1p-12 * l.norm * m.norm) {
    const double t = value_a / (value_a - value_b);
    const Vec2 p{a.at.x + t * (b.at.x - a.at.x), a.at.y + t * (b.at.y - a.at.y)};
    const double rl = l.residual(p), rm = m.residual(p), scale = 1 / det;
    // On a side of constant x or y, rm and one coefficient of m are exactly 0, and the coordinate stays.
    const Dd x = two_sum(p.x, (l.b * rm - m.b * rl) * scale), y = two_sum(p.y, (m.a * rl - l.a * rm) * scale);
    return {{x.hi, y.hi}, {x.lo, y.lo}, 0};
  }
  const Dd from = l.exactly(a), t = from / (from - l.exactly(b));
  const auto between = [&](double p, double p_rest, double q, double q_rest) {
    const Dd start = two_sum(p, p_rest);
    return start + t * (two_sum(q, q_rest) - start);
  };
  const Dd x = between(a.at.x, a.rest.x, b.at.x, b.rest.x), y = between(a.at.y, a.rest.y, b.at.y, b.rest.y);
  return {{x.hi, y.hi}, {x.lo, y.lo}, 0};
}

void SharpClipper::split(const SharpPolygon& in, int slot, SharpPolygon* front, SharpPolygon* back) {
  const Line& l = lines_[static_cast<std::size_t>(slot)];
  const double h = half_width_;
  // Rounding of a value: products, sums, the coefficients' and the vertex's rests.
  const double doubt = 6 * kUnit * (l.norm * h + std::fabs(l.c)) + l.error;
  std::array<double, SharpPolygon::kCapacity> value;
  std::array<signed char, SharpPolygon::kCapacity> sign;
  bool clear = true;
  for (std::size_t i = 0; i < in.size(); ++i) {
    const Vec2 p = in.at(i);
    value[i] = l.a * p.x + l.b * p.y + l.c;
    double unsure = doubt;
    if (std::fabs(value[i]) <= doubt) {
      value[i] = l.exactly(in[i]).hi;
      unsure = 0x1p-70 * l.norm * h + l.error;
      clear = false;
    }
    sign[i] = static_cast<signed char>(value[i] > unsure ? 1 : value[i] < -unsure ? -1 : 0);
    clear &= sign[i] == sign[0];
  }
  if (front != nullptr) front->clear();
  if (back != nullptr) back->clear();
  // A line that stays clear of the polygon cuts nothing and errs in nothing.
  if (clear) {
    if (!in.empty() && sign[0] > 0 && front != nullptr) *front = in;
    if (!in.empty() && sign[0] < 0 && back != nullptr) *back = in;
    return;
  }
  // Both parts, over the length of the line in the window, at most 2 sqrt(2) h; the distance twice, for the vertex and
  // for the line. |l| is at least the length of (a, b). A line without direction may err everywhere.
  const double distance = l.norm > 0 ? 0x1p-66 * h + 3 * l.error / l.norm : 2 * h;
  area_error_ += 2 * 2.83 * h * std::min(distance, 2 * h);

  for (std::size_t i = 0; i < in.size(); ++i) {
    const std::size_t next = i + 1 < in.size() ? i + 1 : 0;
    const SharpVertex a = in[i], b = in[next];
    const int sa = sign[i], sb = sign[next];
    // A part's side along the line begins where its outline reaches the line to leave it.
    if (front != nullptr && sa >= 0) front->push_back({a.at, a.rest, sa == 0 && sb < 0 ? slot : a.side});
    if (back != nullptr && sa <= 0) back->push_back({a.at, a.rest, sa == 0 && sb > 0 ? slot : a.side});
    if (sa * sb >= 0) continue;
    SharpVertex v = meet(a, value[i], b, value[next], l);
    v.side = sa > 0 ? slot : a.side;
    if (front != nullptr) front->push_back(v);
    v.side = sa < 0 ? slot : a.side;
    if (back != nullptr) back->push_back(v);
  }
  for (SharpPolygon* part : {front, back}) {
    if (part != nullptr && part->size() < 3) part->clear();
  }
}

void SharpClipper::append(const SharpPolygon& polygon, double weight, Boundary& out) {
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 a = polygon.at(i), b = polygon.next(i);
    const double largest = std::max({std::fabs(a.x), std::fabs(a.y), std::fabs(b.x), std::fabs(b.y)});
    out.segments.push_back({a, b, weight, polygon[i].side < kWindow ? 0 : kUnit * largest});
  }
}

}  // namespace moire
