// Every number is a sum of terms of one sign, whose factors are right to about 2^-45 or carry their error: kSlack is
// ample for the rest.
#include "testimages/half_covered.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/rounding.h"
#include "testimages/board_side.h"

namespace moire {
namespace {

using Row = LocalHomography::Row;

constexpr double kSlack = 1 + 0x1p-30;

// |a b - c d| for numbers in double-double, at most.
double cross_bound(Dd a, Dd b, Dd c, Dd d) {
  return std::fabs((a * b - c * d).value()) * (1 + 4 * kUnit) +
         0x1p-96 * (std::fabs(a.hi * b.hi) + std::fabs(c.hi * d.hi));
}

// By parts along row s; j is the other row. Appends the first and the second order.
void append_orders(const Row& s, const Row& j, const Row& w, const SharpPolygon& part, double area,
                   const MiddleLine& middle, Unresolved& out) {
  double reach = 0;
  for (std::size_t i = 0; i < part.size(); ++i) {
    reach = std::max({reach, std::fabs(part.at(i).x), std::fabs(part.at(i).y)});
  }
  const double j_noise = row_noise(j, reach), w_noise = row_noise(w, reach), s_noise = row_noise(s, reach);
  // The column j x w / det of the inverse; det = s . (j x w).
  const Dd gx = Dd(j.b) * w.c - Dd(w.b) * j.c, gy = j.c * Dd(w.a) - w.c * Dd(j.a);
  const Dd gz = two_prod(j.a, w.b) - two_prod(j.b, w.a);
  const double gx_error = std::fabs(j.b) * w.c_error + std::fabs(w.b) * j.c_error +
                          0x1p-96 * (std::fabs(j.b * w.c.hi) + std::fabs(w.b * j.c.hi));
  const double gy_error = std::fabs(j.a) * w.c_error + std::fabs(w.a) * j.c_error +
                          0x1p-96 * (std::fabs(j.a * w.c.hi) + std::fabs(w.a * j.c.hi));
  const double gz_error = 0x1p-96 * (std::fabs(j.a * w.b) + std::fabs(j.b * w.a));
  const Dd det_sum = Dd(s.a) * gx + Dd(s.b) * gy + s.c * gz;
  const double det = std::fabs(det_sum.value()) - 2 * kUnit * std::fabs(det_sum.hi) - std::fabs(s.a) * gx_error -
                     std::fabs(s.b) * gy_error - std::fabs(s.c.hi) * gz_error - s.c_error * std::fabs(gz.hi) -
                     0x1p-96 * (std::fabs(s.a * gx.hi) + std::fabs(s.b * gy.hi) + std::fabs(s.c.hi * gz.hi));
  if (!(det > 0)) return;
  const double e = (std::fabs(gz.value()) + gz_error) * kSlack / det;

  // Largest over P, all of them convex functions and so at a vertex: W, |G - e p|, and |W grad J - J grad W| / |det|,
  // which is |G det - e det p| too, as (grad J) W - J grad W turned by a right angle.
  double depth = 0, step = 0;
  // Sums over sides of |C / det| times the integrals of sup|E_1| W and of W^2, window sides apart.
  double first = 0, first_rim = 0, second = 0, second_rim = 0, length = 0;
  double mass = 0, square = 0;  // the integrals of W and of W^2 over P, from a fan of triangles
  for (std::size_t i = 0; i < part.size(); ++i) {
    const Vec2 a = part.at(i), b = part.next(i);
    const Dd ja = row_at(j, a), jb = row_at(j, b), wa = row_at(w, a), wb = row_at(w, b);
    const double da = std::max(wa.value(), 0.0) + w_noise, db = std::max(wb.value(), 0.0) + w_noise;
    depth = std::max(depth, da);
    if (i > 0 && i + 1 < part.size()) {
      const Vec2 o = part.at(0);
      const double d0 = std::max(row_at(w, o).value(), 0.0) + w_noise;
      const double triangle =
          0.5 * std::fabs((a.x - o.x) * (b.y - o.y) - (b.x - o.x) * (a.y - o.y)) + 32 * kUnit * reach * reach;
      mass += triangle * (d0 + da + db) / 3;
      square += triangle * (d0 * d0 + da * da + db * db + d0 * da + da * db + db * d0) / 6;
    }
    const double x = std::fabs((gx - gz * Dd(a.x)).value()) + gx_error + gz_error * reach,
                 y = std::fabs((gy - gz * Dd(a.y)).value()) + gy_error + gz_error * reach;
    step = std::max(step, std::hypot(x, y) / det);
    length += std::hypot(b.x - a.x, b.y - a.y);
    const double along =
        (cross_bound(jb, wa, ja, wb) + j_noise * (da + db) + w_noise * (std::fabs(ja.hi) + std::fabs(jb.hi))) / det;
    double top = 0.5;
    if (part[i].side == middle.slot) {
      // |s - at| along the side, a monotone function between its ends.
      const auto off = [&](Vec2 p, Dd at_w) {
        const Dd value = row_at(s, p) - Dd(middle.at) * at_w;
        const double error = s_noise + std::fabs(middle.at) * w_noise + 0x1p-96 * std::fabs(middle.at * at_w.hi);
        return at_w.hi > 2 * w_noise ? (std::fabs(value.value()) + error) / (at_w.hi - w_noise) * kSlack : 0.5;
      };
      top = std::min(0.5, std::max(off(a, wa), off(b, wb)));
    }
    const bool rim = part[i].side < SharpClipper::kWindow;
    (rim ? first_rim : first) += top * along * 0.5 * (da + db);
    (rim ? second_rim : second) += along * (da * da + da * db + db * db) / 3;
  }
  // A curve of length l inside P: its |C / det| is at most |(grad J) W - J grad W| / |det| = |G - e p| at each place,
  // and a convex one is no longer than P's sides.
  const double curve = step * length * depth;
  const double pole = 2 * std::sqrt(std::numbers::pi * area);  // the integral over P of 1 / distance, at most

  // J / 2, hence the halves.
  const auto append = [&](WeightBounds order) {
    for (double* x : {&order.top, &order.rim, &order.jump, &order.slope, &order.kink, &order.curvature, &order.pole}) {
      *x *= 0.5 * kSlack;
    }
    out.orders[static_cast<std::size_t>(out.known++)] = order;
  };
  append({.top = first + 0.5 * 3 * e * mass, .rim = first_rim, .jump = 0.5 * curve, .slope = 0.5 * step * mass});
  append({.top = first + (3 * e * second + 12 * e * e * square) / 8,
          .rim = first_rim + 3 * e * second_rim / 8,
          .jump = 0.5 * curve + 3 * e * curve * depth / 8,
          .slope = (step * (second + second_rim) + 8 * e * step * square) / 8,
          .kink = step * curve * depth / 8,
          .curvature = step * step * square / 8,
          .pole = step * step * depth * depth * pole / 8});
}

}  // namespace

Unresolved half_covered(const LocalHomography& local, const SharpPolygon& part, const MiddleLine& middle) {
  Unresolved out;
  double area = 0, terms = 0;
  for (std::size_t i = 0; i < part.size(); ++i) {
    const Vec2 a = part.at(i), b = part.next(i);
    area += 0.5 * (a.x * b.y - b.x * a.y);
    terms += std::fabs(a.x * b.y) + std::fabs(b.x * a.y);
  }
  area = std::fabs(area) + 16 * kUnit * terms;
  out.area = 0.5 * area * kSlack;
  const MiddleLine of_u = middle.of_u ? middle : MiddleLine{}, of_v = middle.of_u ? MiddleLine{} : middle;
  append_orders(local.u, local.v, local.w, part, area, of_u, out);
  append_orders(local.v, local.u, local.w, part, area, of_v, out);
  return out;
}

}  // namespace moire
