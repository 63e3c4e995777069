#include "testimages/board_frame.h"

#include <algorithm>
#include <cmath>

#include "core/rounding.h"

namespace moire {
namespace {

using Row = LocalHomography::Row;

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

}  // namespace

BoardFrame::BoardFrame(const Row& s, const Row& j, const Row& third)
    : smooth(s),
      jump(j),
      w(third),
      det(determinant(s, j, third)),
      e(over(minor(j, third), 0x1p-98 * minor_size(j, third), det)) {}

bool BoardFrame::valid() const { return det.value != 0 && det.error <= 0x1p-21 * std::fabs(det.value); }

Bounded BoardFrame::e_times(double factor) const {
  return {e.value * factor, (e.error + kUnit * std::fabs(e.value)) * factor};
}

BoardFrame::Drift BoardFrame::drift(Vec2 p, double factor) const {
  const double reach = std::max(std::fabs(p.x), std::fabs(p.y));
  const Dd j = row_at(jump, p), d = row_at(w, p);
  const auto part = [&](double jump_slope, double w_slope) {
    const double error = std::fabs(jump_slope) * (row_noise(w, reach) + 0x1p-98 * std::fabs(d.hi)) +
                         std::fabs(w_slope) * (row_noise(jump, reach) + 0x1p-98 * std::fabs(j.hi));
    const Bounded b = over(Dd(jump_slope) * d - Dd(w_slope) * j, error, det);
    return Bounded{b.value * factor, (b.error + kUnit * std::fabs(b.value)) * factor};
  };
  return {part(jump.b, w.b), part(-jump.a, -w.a)};
}

}  // namespace moire
