// u = 2^-53 throughout. Errors of one term w K(x) k(y) h of a quadrature sum, h half the piece's extent in y:
//  - K and k as functions: K_error and k_error of their pieces (fit, coefficients, evaluation);
//  - the point (x, y), where it is off its curve: that moves K by k and k by its slope times the distance;
//  - weight, h and the products: some u of the term.
// Weights add up to 2, so these sum to bounds over the knot cell that the piece crosses times its |dy|. Terms are added
// with compensation.
#include "engine/boundary_integral.h"

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

BoundaryIntegral::BoundaryIntegral(const Kernel& kernel) : kernel_(kernel), beside_(kernel) {
  // On a straight piece inside one knot cell K(x(s)) k(y(s)) is a polynomial of degree 2 d + 1: d + 1 nodes are exact.
  // For high degrees fewer nodes do: x and y stay in the ellipse of their knot interval when s is in that of the piece.
  line_nodes_ = kernel.degree() + 1;
  line_remainder_ = 0;
  if (kernel.degree() >= 6) {
    double largest[std::size(kEllipses)];  // of K k over the ellipses, on any two pieces
    for (std::size_t i = 0; i < std::size(kEllipses); ++i) {
      double k_bound = 0, K_bound = 0;
      for (int p = 0; p < kernel.pieces(); ++p) {
        k_bound = std::max(k_bound, kernel.k_on_ellipse(p, kEllipses[i]));
        K_bound = std::max(K_bound, kernel.K_on_ellipse(p, kEllipses[i]));
      }
      largest[i] = k_bound * K_bound;
    }
    for (int n = 4; n < line_nodes_ && n <= kMaxNodes; ++n) {
      double best = HUGE_VAL;
      for (std::size_t i = 0; i < std::size(kEllipses); ++i)
        best = std::min(best, gauss_remainder(i, n) * largest[i] / 2);
      if (best > kRemainder * kernel.k_max() && n < kMaxNodes) continue;
      line_nodes_ = n;
      line_remainder_ = best;
    }
  }
  cut_error_ = 24 * kUnit * kernel.radius();  // Arc::passes()
}

void BoundaryIntegral::reset() {
  sum_ = {};
  error_ = 0;
}

double BoundaryIntegral::bound() const {
  return (error_ + 2 * kUnit * std::fabs(value())) * (1 + 0x1p-20);  // the bound's own rounding
}

// The integral of k(y) dy from y0 to y1, where K(x) = 1.
void BoundaryIntegral::add_closed_form(double weight, double y0, double y1) {
  sum_.add(weight * (kernel_.K(y1) - kernel_.K(y0)));
  error_ += std::fabs(weight) * (2 * kernel_.K_error() + 2 * kUnit * kernel_.K_max());
}

// The segment becomes a chain whose inner vertices lie on knots exactly: each of its pieces is in one knot cell, ends
// included, and nothing is evaluated beyond a knot. What is left to bound is the area between chain and segment.
void BoundaryIntegral::add(const Segment& s) {
  const double dx = s.b.x - s.a.x, dy = s.b.y - s.a.y;
  const double r = kernel_.radius();
  // Clear of the support by more than its doubt, or nothing at all. Near the support's ends these differences are
  // exact.
  const double doubt = s.doubt;
  if (std::min(s.a.y, s.b.y) - r >= doubt || std::max(s.a.y, s.b.y) + r <= -doubt ||
      std::max(s.a.x, s.b.x) + r <= -doubt || (dy == 0 && doubt == 0)) {
    return;
  }
  if (std::min(s.a.x, s.b.x) - r >= doubt) return add_closed_form(s.weight, s.a.y, s.b.y);
  const auto knots = kernel_.knots();
  const int pieces = kernel_.pieces();
  const auto knot = [&](int i) {
    return i < 0 ? -HUGE_VAL : i > pieces ? HUGE_VAL : knots[static_cast<std::size_t>(i)];
  };

  // One coordinate's walk from knot to knot: `t` is the parameter of the next one, above 1 when there is none.
  struct Walk {
    double from, to, d, t;
    int piece, next, step;
  };
  const auto advance = [&](Walk& w) {
    const double at = knot(w.next);
    w.t = (w.d > 0 ? at < w.to : at > w.to) ? (at - w.from) / w.d : 2;
  };
  const auto start = [&](double from, double to, double d) {
    Walk w{from, to, d, 2, kernel_.piece_of(from), 0, d < 0 ? -1 : 1};
    if (d < 0 && from == knot(w.piece)) --w.piece;
    w.next = d < 0 ? w.piece : w.piece + 1;
    if (d != 0) advance(w);
    return w;
  };
  Walk x = start(s.a.x, s.b.x, dx), y = start(s.a.y, s.b.y, dy);

  // The coordinate of a vertex that lies on a knot of the other one, counted from the segment's nearer end: five
  // roundings of at most half the extent and the last one. Put back into its cell, from which rounding may have
  // carried it; that distance comes on top.
  const auto rounding = [](const Walk& w) {
    return w.d == 0 ? 0 : kUnit * (2.5 * std::fabs(w.d) + std::max(std::fabs(w.from), std::fabs(w.to)));
  };
  const double rounding_x = rounding(x), rounding_y = rounding(y);
  double moved = 0;
  const auto across = [&](const Walk& along, double at, const Walk& w) {
    const double c = along.t <= 0.5 ? w.from + along.t * w.d : w.to + (at - along.to) / along.d * w.d;
    const double kept = std::clamp(c, knot(w.piece), knot(w.piece + 1));
    moved = std::fabs(kept - c);
    return kept;
  };
  Vec2 last = s.a;
  bool cut_before = false;
  double moved_before = 0;
  for (;;) {
    const bool end = x.t > 1 && y.t > 1;
    const Cell in = cell(x.piece, y.piece);
    Vec2 at = s.b;
    moved = 0;
    if (!end) {
      Walk& w = x.t <= y.t ? x : y;
      const double on = knot(w.next);
      at = &w == &x ? Vec2{on, across(x, on, y)} : Vec2{across(y, on, x), on};
      w.piece += w.step;
      w.next += w.step;
      advance(w);
    }
    const bool chain = cut_before || !end;
    const double off = doubt + std::max(moved, moved_before);
    add_line_piece(last, at, in, s.weight, off + (chain ? rounding_x : 0), off + (chain ? rounding_y : 0));
    if (end) return;
    last = at;
    cut_before = true;
    moved_before = moved;
  }
}

// From a to b inside one knot cell; the true curve is within off_x, off_y of it.
void BoundaryIntegral::add_line_piece(Vec2 a, Vec2 b, const Cell& cell, double weight, double off_x, double off_y) {
  const double dx = b.x - a.x, dy = b.y - a.y, travel = std::fabs(weight * dy);
  // The area between piece and curve, weighed by |k k|: as in the cell, or beyond its sides by a jump and a distance.
  const double area = std::fabs(weight) * (off_x * (std::fabs(dy) + 2 * off_y) + off_y * std::fabs(dx));
  error_ += area * (cell.x.k + cell.x.jump + kernel_.slope_max() * off_x) *
            (cell.y.k + cell.y.jump + kernel_.slope_max() * off_y);
  if (dy == 0 || cell.px < 0 || cell.py < 0 || cell.py >= kernel_.pieces()) return;
  if (cell.px >= kernel_.pieces()) return add_closed_form(weight, a.y, b.y);

  const Rule rule = gauss_legendre(line_nodes_);
  const auto n = rule.node.size();
  const double tx0 = kernel_.t_of(cell.px, a.x), tx1 = kernel_.t_of(cell.px, b.x);
  const double ty0 = kernel_.t_of(cell.py, a.y), ty1 = kernel_.t_of(cell.py, b.y);
  const double mid_x = 0.5 * (tx0 + tx1), half_x = 0.5 * (tx1 - tx0), mid_y = 0.5 * (ty0 + ty1),
               half_y = 0.5 * (ty1 - ty0);
  double tx[kMaxNodes], ty[kMaxNodes], K[kMaxNodes], k[kMaxNodes];
  for (std::size_t i = 0; i < n; ++i) {
    tx[i] = mid_x + half_x * rule.node[i];
    ty[i] = mid_y + half_y * rule.node[i];
  }
  kernel_.K_at(cell.px, {tx, n}, K);
  kernel_.k_at(cell.py, {ty, n}, k);
  double sum = 0;
  for (std::size_t i = 0; i < n; ++i) sum += rule.weight[i] * K[i] * k[i];
  sum_.add(weight * (0.5 * dy) * sum);
  // t of a node: that of the ends, and 4 u for their mean, their difference, its product with the node, and the sum.
  const double x_error = (cell.x.t_error + 4 * kUnit) * kernel_.half_length(cell.px);
  const double y_error = (cell.y.t_error + 4 * kUnit) * kernel_.half_length(cell.py);
  // Weights to 2 u, products and dy to 6 u, the plain sum to n u of the absolute terms.
  error_ += travel *
            (cell.y.k * (cell.x.K_error + cell.x.k * x_error) + cell.x.K * (cell.y.k_error + cell.y.slope * y_error) +
             kUnit * static_cast<double>(line_nodes_ + 8) * cell.x.K * cell.y.k + line_remainder_);
}

}  // namespace moire
