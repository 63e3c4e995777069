// Errors are counted as in boundary_integral.cpp, u = 2^-53: of K and k as functions, of the place, of the arithmetic.
#include "engine/swept_path.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "core/rounding.h"
#include "curve/quadrature.h"

namespace moire {
namespace {

// Quadrature remainders are pushed below this share of the integrand's scale: well under rounding.
constexpr double kRemainder = 0x1p-57;

}  // namespace

// One coordinate on its way from knot to knot: `t` is the time of the next one, 2 when there is none.
struct SweptPath::Walker {
  double from, d, t;
  int piece;
};

SweptPath::SweptPath(const Kernel& kernel, Vec2 motion) : kernel_(kernel), motion_(motion) {
  // Inside a cell K(x(t)) k(y(t)) is a polynomial of degree 2 d + 1: d + 1 nodes are exact. For high degrees fewer do:
  // x and y stay in the ellipse of their knot interval when t is in that of the stretch.
  nodes_ = kernel.degree() + 1;
  remainder_ = 0;
  if (kernel.degree() < 6) return;
  for (int n = 4; n < nodes_ && n <= kMaxNodes; ++n) {
    double best = HUGE_VAL;
    for (std::size_t i = 0; i < std::size(kEllipses); ++i) {
      double k = 1, K = 1;  // at least 1, so that the remainder serves for K alone and for k alone, too
      for (int p = 0; p < kernel.pieces(); ++p) {
        k = std::max(k, kernel.k_on_ellipse(p, kEllipses[i]));
        K = std::max(K, kernel.K_on_ellipse(p, kEllipses[i]));
      }
      best = std::min(best, gauss_remainder(i, n) * k * K / 2);
    }
    if (best > kRemainder * kernel.k_max() && n < kMaxNodes) continue;
    nodes_ = n;
    remainder_ = best;
  }
}

SweptPath::Walker SweptPath::walker(double from, double d) const {
  Walker w{from, d, 2, kernel_.piece_of(from)};
  if (d < 0 && w.piece >= 0 && from == kernel_.knots()[static_cast<std::size_t>(w.piece)]) --w.piece;
  advance(w);
  return w;
}

// Finds the time of the next knot; the piece is the one that the walker is in.
void SweptPath::advance(Walker& w) const {
  const int next = w.d > 0 ? w.piece + 1 : w.piece;
  const bool none = w.d == 0 || next < 0 || next > kernel_.pieces();
  w.t = none ? 2 : (kernel_.knots()[static_cast<std::size_t>(next)] - w.from) / w.d;
}

template <class F>
void SweptPath::walk(Vec2 p, F&& f) const {
  Walker x = walker(p.x, motion_.x), y = walker(p.y, motion_.y);
  Stretch s{0, 1, x.piece, y.piece, Cut::time, Cut::time};
  while (x.t < 1 || y.t < 1) {
    const bool by_x = x.t <= y.t;
    Walker& w = by_x ? x : y;
    s.t1 = w.t;
    s.last = by_x ? Cut::x_knot : Cut::y_knot;
    f(s);
    w.piece += w.d > 0 ? 1 : -1;
    advance(w);
    s = {s.t1, 1, x.piece, y.piece, s.last, Cut::time};
  }
  f(s);
}

void SweptPath::split(Vec2 p, std::vector<Stretch>& out) const {
  out.clear();
  walk(p, [&](const Stretch& s) { out.push_back(s); });
}

double SweptPath::jump(int knot) const { return std::min(kernel_.bounds(knot - 1).jump, kernel_.bounds(knot).jump); }

void SweptPath::add_near_knots(double y, const Doubt& doubt, Mean& mean) const {
  const auto knots = kernel_.knots();
  const auto first = std::lower_bound(knots.begin(), knots.end(), y - doubt.thick);
  for (auto k = first; k != knots.end() && *k <= y + doubt.thick; ++k) {
    const double wrong = jump(static_cast<int>(k - knots.begin())) + 2 * kernel_.slope_max() * doubt.thick;
    mean.error += doubt.thick / std::fabs(motion_.y) * (wrong + 2 * kernel_.k_error()) * doubt.K_top;
  }
}

SweptPath::Mean SweptPath::mean(Vec2 p, int py, const Doubt& doubt) const {
  const Rule rule = gauss_legendre(nodes_);
  const auto n = rule.node.size();
  const auto knots = kernel_.knots();
  const int pieces = kernel_.pieces();
  // K at places within `off` of the true ones; half of it again for nodes clamped into their cell and for cuts that are
  // off, which last for a small part of any motion that counts as one (swept_integral.h).
  const double k_off = 1.5 * kernel_.k_max() * doubt.off;
  const double late = motion_.y == 0 ? 0 : std::min(1.0, doubt.off / std::fabs(motion_.y));
  Mean mean;
  double tx[kMaxNodes], ty[kMaxNodes], K[kMaxNodes], k[kMaxNodes];
  walk(p, [&](Stretch s) {
    if (motion_.y == 0) s.py = py;
    if (!s.counts(pieces)) return;
    const Kernel::PieceBounds &x = kernel_.bounds(s.px), &y = kernel_.bounds(s.py);
    // A cut at a knot of y is off by as long as the path is within `off` of it; at one of x both sides agree. Each knot
    // counts once: those where the path enters the support at its beginning, the others where a stretch ends.
    const auto add_late = [&](int knot) {
      mean.error += late * (jump(knot) + 2 * (kernel_.k_error() + kernel_.slope_max() * doubt.off)) * x.K;
    };
    const int ahead = motion_.y > 0 ? s.py + 1 : s.py, behind = motion_.y > 0 ? s.py : s.py + 1;
    if (s.last == Cut::y_knot) add_late(ahead);
    if (s.first == Cut::y_knot && (behind == 0 || behind == pieces)) add_late(behind);
    const double extent = s.t1 - s.t0;
    if (!(extent > 0)) return;
    const auto iy = static_cast<std::size_t>(s.py);
    const bool right = s.px >= pieces;
    const auto ix = static_cast<std::size_t>(right ? 0 : s.px);
    const double mid = 0.5 * (s.t0 + s.t1);
    for (std::size_t i = 0; i < n; ++i) {
      const double t = mid + 0.5 * extent * rule.node[i];
      tx[i] = kernel_.t_of(static_cast<int>(ix), std::clamp(p.x + t * motion_.x, knots[ix], knots[ix + 1]));
      ty[i] = kernel_.t_of(s.py, std::clamp(p.y + t * motion_.y, knots[iy], knots[iy + 1]));
    }
    kernel_.k_at(s.py, {ty, n}, k);
    double sum = 0;
    if (right) {
      for (std::size_t i = 0; i < n; ++i) sum += rule.weight[i] * k[i];
    } else {
      kernel_.K_at(s.px, {tx, n}, K);
      for (std::size_t i = 0; i < n; ++i) sum += rule.weight[i] * K[i] * k[i];
    }
    mean.value += 0.5 * extent * sum;
    mean.top += extent * x.K * y.k;
    mean.error +=
        extent * (y.k * (x.K_error_at_x + (right ? 0 : k_off)) + x.K * (y.k_error_at_x + 1.5 * y.slope * doubt.off) +
                  kUnit * (nodes_ + 12) * x.K * y.k + remainder_);
  });
  if (motion_.y != 0) {
    add_near_knots(p.y, doubt, mean);
    add_near_knots(p.y + motion_.y, doubt, mean);
  }
  return mean;
}

SweptPath::Mean SweptPath::mean_K(double y, double off) const {
  const Rule rule = gauss_legendre(nodes_);
  const auto n = rule.node.size();
  const auto knots = kernel_.knots();
  const int pieces = kernel_.pieces();
  Mean mean;
  double ty[kMaxNodes], K[kMaxNodes];
  walk({kernel_.radius() + std::fabs(motion_.x), y}, [&](const Stretch& s) {
    const double extent = s.t1 - s.t0;
    if (s.py < 0 || !(extent > 0)) return;
    mean.top += extent * kernel_.bounds(s.py).K;
    if (s.py >= pieces) {
      mean.value += extent;
      return;
    }
    const auto iy = static_cast<std::size_t>(s.py);
    for (std::size_t i = 0; i < n; ++i) {
      const double t = 0.5 * (s.t0 + s.t1) + 0.5 * extent * rule.node[i];
      ty[i] = kernel_.t_of(s.py, std::clamp(y + t * motion_.y, knots[iy], knots[iy + 1]));
    }
    kernel_.K_at(s.py, {ty, n}, K);
    double sum = 0;
    for (std::size_t i = 0; i < n; ++i) sum += rule.weight[i] * K[i];
    mean.value += 0.5 * extent * sum;
    const Kernel::PieceBounds& b = kernel_.bounds(s.py);
    mean.error += extent * (b.K_error_at_x + kernel_.k_max() * off + kUnit * (nodes_ + 12) * b.K + remainder_);
  });
  return mean;
}

// On a stretch all is a straight line between its ends, complex ones, too, and its coordinates leave the cell by no
// more than at the ends: there one coordinate is on a knot and its time moves with it, or the time is fixed.
double SweptPath::top(std::span<const Stretch> stretches, Vec2 reach) const {
  const int pieces = kernel_.pieces();
  const Vec2 d{std::fabs(motion_.x), std::fabs(motion_.y)};
  double sum = 0;
  for (const Stretch& s : stretches) {
    if (!s.counts(pieces)) continue;
    double extent = s.t1 - s.t0, off_x = 0, off_y = 0;
    for (const Cut cut : {s.first, s.last}) {
      switch (cut) {
        case Cut::time:
          off_x = std::max(off_x, reach.x);
          off_y = std::max(off_y, reach.y);
          break;
        case Cut::x_knot:
          extent += reach.x / d.x;
          off_y = std::max(off_y, reach.y + reach.x * d.y / d.x);
          break;
        case Cut::y_knot:
          extent += reach.y / d.y;
          off_x = std::max(off_x, reach.x + reach.y * d.x / d.y);
          break;
      }
    }
    const double K =
        s.px >= pieces ? 1 : kernel_.K_on_ellipse(s.px, ellipse_of_disk(off_x / kernel_.half_length(s.px)));
    sum += extent * K * kernel_.k_on_ellipse(s.py, ellipse_of_disk(off_y / kernel_.half_length(s.py)));
  }
  return sum;
}

}  // namespace moire
