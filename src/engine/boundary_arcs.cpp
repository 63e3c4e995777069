// Circles in the boundary integral: quarters, cut at the kernel's knots. How errors are counted: boundary_integral.cpp.
#include <algorithm>
#include <cmath>
#include <iterator>
#include <span>

#include "core/rounding.h"
#include "curve/quadrature.h"
#include "engine/boundary_integral.h"

namespace moire {
namespace {

// Quadrature remainders are pushed below this share of the integrand's scale: well under rounding.
constexpr double kRemainder = 0x1p-57;
constexpr int kMostNodes = 20;

}  // namespace

void BoundaryIntegral::add(const Circle& circle) {
  const double r = kernel_.radius();
  // Tiny: K(x) may be replaced by the integral of k from the circle's centre to x, since k(y) dy integrates to nothing
  // around a closed curve. Both factors then shrink with the circle, and so does the error: relative accuracy holds
  // down to any radius.
  const bool near = circle.radius <= 4 * r, tiny = circle.radius <= r / 8;
  if (tiny) {
    beside_.place(circle.center.x, circle.center_rest.x, circle.radius * (1 + 0x1p-40));
    // An extreme point may pass a knot by some u of the radius and not be cut there: the area beyond is below
    // (8 u)^1.5 of the radius squared.
    error_ += 0x1p-70 * circle.radius * circle.radius * kernel_.k_max() * kernel_.k_max();
  } else {
    // Likewise, and past the window's sides: an extreme point is known to some u of the smaller of circle and window.
    // A segment of height h has a chord of 2 sqrt(2 radius h), and 4/3 sqrt(2 radius) h^1.5 of area.
    const double h = 8 * kUnit * std::min(circle.radius, 4 * r);
    error_ += std::min(1.9 * std::sqrt(circle.radius * h) * h, 2 * r * h) * kernel_.k_max() * kernel_.k_max();
  }
  for (const Quarter which : {Quarter::left, Quarter::upper, Quarter::right, Quarter::lower}) {
    const Rect place = around(circle, which);
    if (place.hi.y < -r || place.lo.y > r || (!tiny && place.hi.x < -r)) continue;
    const Arc arc = quarter(circle, which, near);
    add_arc(arc, tiny, place);
    // The gap between two quarters (arc.h): half of it for each.
    for (const double end : {arc.v0, arc.v1}) {
      if (tiny) {
        const CentredKnots down = knots_down(circle);
        const double other = arc.side * std::sqrt((circle.radius - end) * (circle.radius + end));
        const Kernel::PieceBounds& y = kernel_.bounds(down.piece_of(arc.upright ? end : other));
        error_ += kUnit * circle.radius * beside_.top() * (y.k + y.jump + kernel_.slope_max() * kUnit * circle.radius);
        continue;
      }
      if (std::fabs(arc.run(end)) > 1.01 * r || std::fabs(arc.other(end)) > 1.01 * r) continue;
      const double gap = kUnit * (near ? 1.07 * circle.radius : 1.01 * r);
      error_ += 0.5 * gap * kernel_.K_max() * kernel_.k_max();
    }
  }
}

// Where a quarter is cut: near its knots within cut_error_, either way free of cancellation.
void BoundaryIntegral::add_arc(const Arc& arc, bool tiny, const Rect& place) {
  const double r = kernel_.radius();
  double from = std::max(arc.v0, arc.v_of(-r)), to = arc.v1;
  if (arc.upright) to = std::min(to, arc.v_of(r));
  if (tiny && !arc.upright) from = arc.v0;  // the centred antiderivative does not vanish left of the support
  if (!(from < to)) return;
  cuts_.assign({from, to});
  // Right of the support nothing may be cut: there a piece counts by its ends alone, and far out on a large circle
  // these are not known well enough to tell K(y) = 0 from a little more.
  const double last_cut = arc.upright || tiny ? to : std::min(to, arc.v_of(r));
  const auto cut = [&](double v) {
    if (v > from && v <= last_cut && v < to) cuts_.push_back(v);
  };
  // The quarter's rectangle exceeds it by far more than a cut is off, so that no knot outside makes one.
  const auto knots = kernel_.knots();
  const auto within = [&](double lo, double hi) {
    const auto first = std::lower_bound(knots.begin(), knots.end(), lo);
    return std::span(first, std::upper_bound(first, knots.end(), hi));
  };
  const auto in_x = within(place.lo.x, place.hi.x), in_y = within(place.lo.y, place.hi.y);
  for (const double knot : arc.upright ? in_y : in_x) cut(arc.v_of(knot));
  for (const double knot : arc.upright ? in_x : in_y) {
    for (const double v : arc.passes(knot)) cut(v);
  }
  std::sort(cuts_.begin(), cuts_.end());
  for (std::size_t i = 0; i + 1 < cuts_.size(); ++i) {
    if (cuts_[i] < cuts_[i + 1]) add_arc_piece(arc, tiny, cuts_[i], cuts_[i + 1], 0);
  }
}

// Which knot cell a piece of a quarter is in. Its ends lie on knots only up to rounding, and so does the middle of one
// that touches a knot. The mean of the three is inside: a cell is convex.
BoundaryIntegral::Cell BoundaryIntegral::arc_cell(const Arc& arc, bool tiny, const ArcMiddle& middle, double half) {
  const ArcMiddle::Point from = middle.at(-half), to = middle.at(half);
  const double run = tiny ? middle.relative : middle.run.hi;
  const double other = tiny ? 0.5 * middle.offset + 0.25 * (from.offset + to.offset)
                            : 0.5 * middle.other.hi + 0.25 * (from.other + to.other);
  const double x = arc.upright ? other : run, y = arc.upright ? run : other;
  // A mean within `miss` of a knot: the three points are on the right side of it up to `miss`, so within 7 times that,
  // a parabola through them stays within 9 times over the whole piece, and the circle within 16. There the polynomials
  // of both sides differ by the jump and twice the slope times the distance.
  const double miss = miss_of(arc, tiny), thick = 16 * miss;
  const double beyond = 2 * kernel_.slope_max() * thick + 2 * kernel_.k_error();
  if (tiny) {
    // Such circles can be smaller than an ulp of where they are: their pieces are told apart from the centre, as their
    // cuts were made. The integral from the centre is no polynomial's beyond a knot of x: that counts for the integral
    // and for the nodes.
    const CentredKnots down = knots_down(arc.circle);
    const Cell found = cell(beside_.knots().piece_of(x), down.piece_of(y));
    const double wrong_y = found.y.jump + beyond;
    if (beside_.knots().near_knot(found.px, x, miss))
      error_ += 4 * half * thick * (found.x.jump + beyond) * (found.y.k + wrong_y);
    if (down.near_knot(found.py, y, miss)) error_ += 2 * thick * wrong_y * beside_.top();
    return found;
  }
  const Cell found = cell(kernel_.piece_of(x), kernel_.piece_of(y));
  if (kernel_.near_knot(found.px, x, miss)) error_ += 2 * half * thick * (found.x.jump + beyond) * kernel_.k_max();
  if (kernel_.near_knot(found.py, y, miss)) error_ += 2 * thick * (found.y.jump + beyond) * kernel_.K_max();
  return found;
}

// How far from where it should be a cut is: Arc::passes(). From a tiny circle's centre places are right to 8 u of its
// radius: knots to 2 u (CentredKnots), the root and what it moves the other coordinate by to 6 u.
double BoundaryIntegral::miss_of(const Arc& arc, bool tiny) const {
  return tiny ? 8 * kUnit * arc.circle.radius : cut_error_ + 0x1p-98 * arc.circle.radius;
}

CentredKnots BoundaryIntegral::knots_down(const Circle& c) const { return {kernel_, c.center.y, c.center_rest.y}; }

void BoundaryIntegral::add_arc_piece(const Arc& arc, bool tiny, double from, double to, int depth) {
  const double mid = 0.5 * (from + to), half = 0.5 * (to - from);
  const double r = kernel_.radius(), radius = arc.circle.radius;
  const ArcMiddle middle(arc, mid);
  const Cell in = arc_cell(arc, tiny, middle, half);
  const int px = in.px, py = in.py;
  // Walking order: the circle goes from +x towards +y, so y grows on the right quarter and x shrinks on the lower one.
  const double direction = arc.upright ? arc.side : -arc.side;
  const double miss = miss_of(arc, tiny);
  // How far k goes wrong beyond a knot that the cut misses, in x and in y.
  const double beyond = 2 * kernel_.k_error() + 2 * kernel_.slope_max() * miss;
  const double wrong_x = in.x.jump + beyond, wrong_y = in.y.jump + beyond;
  if (!tiny) {
    if (px < 0) return;
    if (px >= kernel_.pieces()) {
      // Inside the support both ends are known to their rounding.
      error_ += 2 * (1.01 * kUnit * r + 0x1p-98 * radius) * kernel_.k_max();
      error_ += std::min(2 * half, 2 * r) * miss * wrong_x * kernel_.k_max();
      const double y0 = arc.upright ? arc.run(from) : arc.other(from), y1 = arc.upright ? arc.run(to) : arc.other(to);
      return add_closed_form(direction, y0, y1);
    }
  }
  if (py < 0 || py >= kernel_.pieces()) return;

  // Remainder: v in the ellipse rho around the piece is at most `reach` from its middle. There |v - centre| <= e R, so
  // that |d other / d v| <= e / sqrt(1 - e^2), and the other coordinate stays in a disk around the middle's.
  const double off_centre = std::fabs(middle.relative) / radius;
  // The middle itself may be `miss` outside its cell, or 16 times that (arc_cell). Where pieces are not very short, at
  // least 2^-20 of the radius, that makes rho at most 2^-11 larger and the bounds 2^-11 (2 degree + 1), less than the
  // 5% by which gauss_remainder() is too large for 4 nodes and more: 32/15 there is below 2.04.
  const auto ellipse = [&](double disk, int p) {
    if (p < 0 || p >= kernel_.pieces()) return 1.0;
    const double piece_half = kernel_.half_length(p);
    return ellipse_of_disk((disk + (piece_half < 0x1p-20 * r ? 16 * miss : 0)) / piece_half);
  };
  const double scale = tiny ? radius * kernel_.k_max() * kernel_.k_max() : kernel_.k_max();
  int nodes = 0;
  double remainder = HUGE_VAL;
  for (std::size_t i = 0; i < std::size(kEllipses); ++i) {
    const double rho = kEllipses[i];
    const double reach = half * (rho + 1 / rho) / 2;
    const double e = off_centre + reach / radius;
    if (e > 0.96 || nodes == 4) break;
    const double root = std::sqrt((1 - e) * (1 + e));
    const double reach_other = reach * e / root;
    const double rho_run = ellipse(reach, arc.upright ? py : px);
    const double rho_other = ellipse(reach_other, arc.upright ? px : py);
    const double k_bound = kernel_.k_on_ellipse(py, arc.upright ? rho_run : rho_other);
    double K_bound = 0;
    if (tiny) {
      // The integral of k from the centre to x runs along the real axis to a knot or to the piece's middle, at most R,
      // and from there to x inside the disk around the middle or the ellipse: at most sqrt(2) R + R, |x - centre| <=
      // sqrt(2) R.
      const double slope = px < 0 || px >= kernel_.pieces()
                               ? kernel_.k_max()
                               : std::max(kernel_.k_max(), kernel_.k_on_ellipse(px, arc.upright ? rho_other : rho_run));
      K_bound = 4 * radius * slope;
    } else {
      K_bound = kernel_.K_on_ellipse(px, arc.upright ? rho_other : rho_run);
    }
    const double bound = k_bound * K_bound * (arc.upright ? 1 : e / root);
    for (int n = 4; n <= kMostNodes; n += 2) {
      if (nodes != 0 && n >= nodes) break;
      const double share = gauss_remainder(i, n) * bound * half;
      if (share > kRemainder * scale * half) continue;
      nodes = n;
      remainder = share;
    }
  }
  if (nodes == 0) {
    if (depth < 40) {
      add_arc_piece(arc, tiny, from, mid, depth + 1);
      add_arc_piece(arc, tiny, mid, to, depth + 1);
      return;
    }
    nodes = kMostNodes;  // a piece 2^-40 of a quarter: its whole contribution is the bound
    remainder = 4 * half * scale;
  }

  const Rule rule = gauss_legendre(nodes);
  const auto n = rule.node.size();
  double tx[kMaxNodes], ty[kMaxNodes], rise[kMaxNodes], K[kMaxNodes], k[kMaxNodes];
  double sum = 0, travel = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const ArcMiddle::Point p = middle.at(half * rule.node[i]);
    // dy = -(x - centre) / (y - centre) dx on the upper and lower quarters.
    rise[i] = rule.weight[i] * (arc.upright ? 1.0 : -p.relative / p.offset);
    travel += std::fabs(rise[i]);
    ty[i] = kernel_.t_of(py, arc.upright ? p.run : p.other);
    if (tiny) {
      K[i] = beside_(arc.upright ? p.offset : p.relative);
    } else {
      tx[i] = kernel_.t_of(px, arc.upright ? p.other : p.run);
    }
  }
  if (!tiny) kernel_.K_at(px, {tx, n}, K);
  kernel_.k_at(py, {ty, n}, k);
  for (std::size_t i = 0; i < n; ++i) sum += rise[i] * K[i] * k[i];
  sum_.add(direction * half * sum);
  error_ += remainder;
  const double length = 2 * half;  // |dy| <= |dv| on every quarter
  const double K_top = tiny ? beside_.top() : in.x.K;
  if (tiny) {
    // k at a place rounded to u of itself and off by 8 u of the radius; the other factor's error is known for the whole
    // circle. Nodes and integral up to `miss` beyond a knot of x, as in arc_cell.
    const double place = kUnit * (1.01 * (std::fabs(arc.circle.center.y) + radius) + 8 * radius);
    error_ += length * (in.y.k * beside_.error() + K_top * (in.y.k_error_at_x + in.y.slope * place) +
                        kUnit * (nodes + 32) * K_top * in.y.k + 2 * miss * wrong_x * in.y.k);
  } else {
    travel *= half;
    // arc.h; and 2 u half for the node itself, which is as good as another point of the circle. |coordinate| <= 1.01 W.
    const double place = kUnit * (1.01 * r + 11 * half) + 0x1p-98 * radius;
    // The slope of the lower and upper quarters errs by 6 u |dv| besides 9 u of itself.
    error_ +=
        travel * (in.y.k * (in.x.K_error_at_x + in.x.k * place) + K_top * (in.y.k_error_at_x + in.y.slope * place) +
                  kUnit * (nodes + 20) * K_top * in.y.k + miss * wrong_x * in.y.k) +
        6 * kUnit * length * K_top * in.y.k;
  }
  // Where the curve passes a knot of y, at an end or without having been cut there, k is wrong over at most `miss`.
  if (wrong_y * (tiny ? 1 / kernel_.k_max() : K_top) < 0x1p-40) {
    error_ += 4 * miss * wrong_y * K_top;
    return;
  }
  const auto passes = [&](double tau) {
    const ArcMiddle::Point p = middle.at(tau);
    return tiny ? knots_down(arc.circle).near_knot(py, arc.upright ? p.relative : p.offset, 4 * miss)
                : kernel_.near_knot(py, arc.upright ? p.run : p.other, 4 * miss);
  };
  const double extreme = arc.side * radius;
  const bool touches = !arc.upright && (tiny ? knots_down(arc.circle).near_knot(py, extreme, 4 * miss)
                                             : kernel_.near_knot(py, arc.c_other + extreme, 4 * miss));
  error_ += (passes(-half) + passes(half) + 2 * touches) * miss * wrong_y * K_top;
}

}  // namespace moire
