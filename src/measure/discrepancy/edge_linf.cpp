// The half-plane that a set of points fills most beyond its area.
//
// The complement of a half-plane has the opposite difference, so the least upper bound is that of count / N - area over
// closed half-planes. Such a half-plane can be moved, losing no point and no value, until its line is critical:
//   through two different points or more; or
//   through one point, in the middle of its chord: there the area is least while the line turns about the point. It
//     cuts a corner of the square; or
//   through one point and parallel to an axis: for points on the border, and for x or y = 1/2, where the area stays the
//     same while the line turns.
#include "measure/discrepancy/edge_linf.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

#include "core/expansion.h"
#include "core/parallel.h"
#include "core/rounding.h"
#include "measure/discrepancy/exact_turn.h"

namespace moire {
namespace {

// The different points, sorted, and how many there are of each.
struct Distinct {
  std::vector<double> x, y;
  std::vector<std::int64_t> count;
  std::int64_t total = 0;

  explicit Distinct(const PointView& points) : total(static_cast<std::int64_t>(points.size())) {
    std::vector<std::size_t> order(points.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      return points.x[a] != points.x[b] ? points.x[a] < points.x[b] : points.y[a] < points.y[b];
    });
    for (const std::size_t i : order) {
      if (!x.empty() && x.back() == points.x[i] && y.back() == points.y[i]) {
        ++count.back();
      } else {
        x.push_back(points.x[i]);
        y.push_back(points.y[i]);
        count.push_back(1);
      }
    }
  }
  std::size_t size() const { return x.size(); }
};

// The largest count / N - area so far. Double precision picks the candidates, 106 bits compare them.
class Largest {
 public:
  Largest(std::int64_t total, Dd from) : n_(dd_from_integer(total)), per_point_(1 / n_.hi), value_(from) {}

  // A half-plane with `count` points; `area` within 9 u, area_dd() the same to about 100 bits.
  template <class Area>
  void offer(std::int64_t count, double area, const Area& area_dd) {
    // What is left out is smaller: the rounding of `rough` is below 9 u + 3 u.
    const double rough = static_cast<double>(count) * per_point_ - area;
    if (rough < value_.hi - 16 * kUnit) return;
    offer(dd_from_integer(count) / n_ - area_dd());
  }
  void offer(Dd value) {
    if ((value - value_).hi > 0) value_ = value;
  }
  Dd value() const { return value_; }

 private:
  Dd n_;
  double per_point_;
  Dd value_;
};

double leading(double v) { return v; }
double leading(Dd v) { return v.hi; }

// Area of the part of the unit square to the left (x to the right, y up) of the line through (x, y) with direction
// (dx, dy), dy >= 0, not both 0. Real is double or Dd, u its unit; dx, dy and below = 1 - y have relative errors of u
// or less. Absolute error below 8 u: the slope r has 3 u, c has 5 u; the triangle twice that and 5 u for an area <=
// 1/2.
template <class Real>
Real area_left_of(Real x, Real y, Real below, Real dx, Real dy) {
  // Upside down if need be, the part is a X + b Y <= a x + b y with a, b >= 0, and has the corner (0, 0).
  const bool flip = leading(dx) > 0;
  const Real a = dy, b = flip ? dx : -dx, up = flip ? below : y;
  // Over the larger one of a and b: r X + Y <= c or X + r Y <= c, with 0 <= r <= 1.
  const bool steep = leading(a - b) > 0;
  const Real r = steep ? b / a : a / b;
  const Real c = steep ? x + r * up : r * x + up;
  if (leading(c - r) >= 0 && leading(c - Real(1.0)) <= 0) return c - Real(0.5) * r;  // r = 0 comes here
  if (leading(c - r) < 0) return Real(0.5) * c * c / r;
  const Real rest = Real(1.0) + r - c;
  return Real(1.0) - Real(0.5) * rest * rest / r;
}

// Half-planes with a line parallel to an axis, given the coordinates along the other one, ascending.
void offer_parallel(const std::vector<double>& sorted, Largest& largest) {
  const std::size_t n = sorted.size();
  for (std::size_t i = 0; i < n; ++i) {
    const double c = sorted[i];
    const Dd rest = two_sum(1, -c);
    // The closed count is that at the last of equal coordinates going up, at the first going down.
    largest.offer(static_cast<std::int64_t>(i + 1), c, [c] { return Dd(c); });
    largest.offer(static_cast<std::int64_t>(n - i), rest.hi, [rest] { return rest; });
  }
}

// The half-plane that cuts the nearest corner of the square with point i in the middle of its chord: in coordinates X,
// Y from that corner h_y X + h_x Y <= 2 h_x h_y, with h the point itself.
void offer_corner(const Distinct& points, std::size_t i, Largest& largest) {
  const bool flip_x = points.x[i] > 0.5, flip_y = points.y[i] > 0.5;
  const double hx = flip_x ? 1 - points.x[i] : points.x[i], hy = flip_y ? 1 - points.y[i] : points.y[i];  // exact
  if (hx == 0 && hy == 0) return;  // a corner of the square: no chord has it in its middle
  const double limit = 2 * hx * hy;
  std::int64_t inside = 0;
  for (std::size_t j = 0; j < points.size(); ++j) {
    const double x = points.x[j], y = points.y[j];
    const double place = hy * (flip_x ? 1 - x : x) + hx * (flip_y ? 1 - y : y), excess = place - limit;
    // Rounding: 3 u of place, u of limit, u of their difference. The 2^-1000 is for products that underflow.
    bool in = excess < 0;
    if (std::fabs(excess) <= 8 * kUnit * (place + limit) + 0x1p-1000) {
      constexpr double kLift = 0x1p500;  // rounding errors of products must not fall below the smallest double
      const double lx = hx * kLift, ly = hy * kLift;
      Expansion exact;
      if (flip_x) exact.add_product(ly, kLift);
      exact.add_product(flip_x ? -ly : ly, x * kLift);
      if (flip_y) exact.add_product(lx, kLift);
      exact.add_product(flip_y ? -lx : lx, y * kLift);
      exact.add_product(-2 * lx, ly);
      in = exact.sign() <= 0;
    }
    if (in) inside += points.count[j];
  }
  largest.offer(inside, limit, [hx, hy] { return two_prod(2 * hx, hy); });
}

// Another point as seen from point i; lines have no direction, so it is turned by half a turn if it lies below.
struct Ray {
  double key;  // grows with the angle, which is in [0, pi): - cos / (|cos| + sin), from -1 to 1
  std::size_t point;
  bool up;  // not turned
};

// Half-planes with a line through point i and another point. `rays` is room to work in.
void offer_lines(const Distinct& points, const ExactTurn& turn, std::size_t i, std::vector<Ray>& rays,
                 Largest& largest) {
  const double x = points.x[i], y = points.y[i];
  rays.clear();
  // Points to the left and to the right of the line through i, which is directed at angle 0, just before it turns.
  std::int64_t left = 0, right = 0;
  for (std::size_t j = 0; j < points.size(); ++j) {
    if (j == i) continue;
    const double dx = points.x[j] - x, dy = points.y[j] - y;  // rounded, with the right signs
    const bool up = dy > 0 || (dy == 0 && dx > 0);
    rays.push_back({(up ? -dx : dx) / (std::fabs(dx) + std::fabs(dy)), j, up});
    (up ? left : right) += points.count[j];
  }
  std::sort(rays.begin(), rays.end(), [](const Ray& a, const Ray& b) { return a.key < b.key; });

  // 1 when b's angle is larger than a's, 0 when they are equal.
  const auto sense = [&](const Ray& a, const Ray& b) {
    const int sign = turn(i, a.point, b.point);
    return a.up == b.up ? sign : -sign;
  };
  // Keys have errors below 2.5 u. Those further apart are in order; chains of closer ones are sorted exactly.
  constexpr double kDoubt = 8 * kUnit;
  for (auto chain = rays.begin(); chain != rays.end();) {
    auto end = chain + 1;
    while (end != rays.end() && end->key - (end - 1)->key <= kDoubt) ++end;
    if (end - chain > 1) std::sort(chain, end, [&](const Ray& a, const Ray& b) { return sense(a, b) > 0; });
    for (auto first = chain; first != end;) {
      // All points on one line through i.
      std::int64_t up = 0, down = 0;
      auto last = first;
      for (; last != end && (last == first || sense(*first, *last) == 0); ++last)
        (last->up ? up : down) += points.count[last->point];
      const std::int64_t closed_left = left + down + points.count[i], closed_right = right + up + points.count[i];
      const std::size_t j = first->point;
      const double turned = first->up ? 1 : -1;
      const double dx = turned * (points.x[j] - x), dy = turned * (points.y[j] - y);
      const double area = area_left_of(x, y, 1 - y, dx, dy);
      const auto area_dd = [&] {
        const Dd exact_dx = two_sum(points.x[j], -x), exact_dy = two_sum(points.y[j], -y);
        return area_left_of(Dd(x), Dd(y), two_sum(1, -y), first->up ? exact_dx : -exact_dx,
                            first->up ? exact_dy : -exact_dy);
      };
      largest.offer(closed_left, area, area_dd);
      largest.offer(closed_right, 1 - area, [&] { return Dd(1.0) - area_dd(); });
      left += down - up;
      right += up - down;
      first = last;
    }
    chain = end;
  }
}

}  // namespace

double edge_linf(const PointView& points) {
  const Distinct distinct(points);
  Largest parallel(distinct.total, 0.0);
  for (const auto& axis : {points.x, points.y}) {
    std::vector<double> sorted(axis.begin(), axis.end());
    std::sort(sorted.begin(), sorted.end());
    offer_parallel(sorted, parallel);
  }

  const ExactTurn turn({distinct.x, distinct.y});
  constexpr std::size_t kGroup = 32;  // points per work item
  const std::size_t n = distinct.size(), groups = (n + kGroup - 1) / kGroup;
  std::vector<Dd> values(groups);
  const auto search = [&](std::size_t group) {
    Largest largest(distinct.total, parallel.value());
    std::vector<Ray> rays;
    rays.reserve(n);
    for (std::size_t i = group * kGroup; i < std::min(n, (group + 1) * kGroup); ++i) {
      offer_corner(distinct, i, largest);
      offer_lines(distinct, turn, i, rays, largest);
    }
    values[group] = largest.value();
  };
  // Waking threads costs more than a few points do.
  if (groups < 4) {
    for (std::size_t group = 0; group < groups; ++group) search(group);
  } else {
    parallel_for(groups, search);
  }
  for (const Dd& value : values) parallel.offer(value);
  return parallel.value().value();
}

}  // namespace moire
