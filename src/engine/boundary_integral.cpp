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
constexpr int kMostNodes = 20;

}  // namespace

BoundaryIntegral::BoundaryIntegral(const Kernel& kernel) : kernel_(kernel) {
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

void BoundaryIntegral::add(const Circle& circle) {
  const double r = kernel_.radius();
  // Tiny: K(x) may be replaced by the integral of k from the circle's centre to x, since k(y) dy integrates to nothing
  // around a closed curve. Both factors then shrink with the circle, and so does the error: relative accuracy holds
  // down to any radius.
  const bool near = circle.radius <= 4 * r, tiny = circle.radius <= r / 8;
  for (const Quarter which : {Quarter::left, Quarter::upper, Quarter::right, Quarter::lower}) {
    const Rect place = around(circle, which);
    if (place.hi.y < -r || place.lo.y > r || (!tiny && place.hi.x < -r)) continue;
    const Arc arc = quarter(circle, which, near);
    add_arc(arc, tiny);
    // The gap between two quarters (arc.h): half of it for each.
    if (tiny) continue;
    for (const double end : {arc.v0, arc.v1}) {
      if (std::fabs(arc.run(end)) > 1.01 * r || std::fabs(arc.other(end)) > 1.01 * r) continue;
      const double gap = kUnit * (near ? 1.07 * circle.radius : 1.01 * r);
      error_ += 0.5 * gap * kernel_.K_max() * kernel_.k_max();
    }
  }
}

// Where a quarter is cut: near its knots within cut_error_, either way free of cancellation.
void BoundaryIntegral::add_arc(const Arc& arc, bool tiny) {
  const double r = kernel_.radius(), radius = arc.circle.radius;
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
  for (const double knot : kernel_.knots()) {
    for (const double v : arc.passes(knot)) cut(v);
  }
  std::sort(cuts_.begin(), cuts_.end());
  if (tiny) {
    // Positions relative to the centre are right to 8 u of the radius.
    error_ += 8 * kUnit * radius * radius * kernel_.k_max() * kernel_.k_max() * static_cast<double>(cuts_.size());
  }
  for (std::size_t i = 0; i + 1 < cuts_.size(); ++i) {
    if (cuts_[i] < cuts_[i + 1]) add_arc_piece(arc, tiny, cuts_[i], cuts_[i + 1], 0);
  }
}

// The integral of k from the circle's centre to xi beside it, in x.
double BoundaryIntegral::delta_K(const Circle& c, double xi) const {
  const double low = std::min(0.0, xi), high = std::max(0.0, xi);
  // The integrand is a polynomial of degree d: ceil((d + 1) / 2) nodes are exact.
  const Rule rule = gauss_legendre(std::min(kernel_.degree() / 2 + 1, kMaxNodes));
  double sum = 0;
  const auto knots = kernel_.knots();
  for (int p = 0; p < kernel_.pieces(); ++p) {
    const auto i = static_cast<std::size_t>(p);
    const double a = std::max(low, (knots[i] - c.center.x) - c.center_rest.x);
    const double b = std::min(high, (knots[i + 1] - c.center.x) - c.center_rest.x);
    if (!(a < b)) continue;
    for (std::size_t j = 0; j < rule.node.size(); ++j) {
      const double at = 0.5 * (a + b) + 0.5 * (b - a) * rule.node[j];
      sum += 0.5 * (b - a) * rule.weight[j] * kernel_.k_piece(p, c.center.x + at);
    }
  }
  return xi < 0 ? -sum : sum;
}

// Which knot cell a piece of a quarter is in. Its ends lie on knots only up to rounding, and so does the middle of one
// that touches a knot. The mean of the three is inside: a cell is convex.
BoundaryIntegral::Cell BoundaryIntegral::arc_cell(const Arc& arc, bool tiny, const ArcMiddle& middle, double half) {
  const ArcMiddle::Point from = middle.at(-half), to = middle.at(half);
  // Tiny circles can be smaller than an ulp of where they are: their pieces are told apart relative to the centre, as
  // their cuts were made.
  if (tiny) {
    const auto piece_of = [&](double relative, double c, double rest) {
      int p = -1;
      for (const double knot : kernel_.knots()) p += (knot - c) - rest <= relative;
      return p;
    };
    const int run = piece_of(middle.relative, arc.c_run, arc.rest_run);
    const double offset = 0.5 * middle.offset + 0.25 * (from.offset + to.offset);
    const int other = piece_of(offset, arc.c_other, arc.rest_other);
    return arc.upright ? cell(other, run) : cell(run, other);
  }
  const double run = middle.run.hi, other = 0.5 * middle.other.hi + 0.25 * (from.other + to.other);
  const Cell found = arc.upright ? cell(kernel_.piece_of(other), kernel_.piece_of(run))
                                 : cell(kernel_.piece_of(run), kernel_.piece_of(other));
  // A mean within `miss` of a knot: the three points are on the right side of it up to `miss`, so within 7 times that,
  // a parabola through them stays within 9 times over the whole piece, and the circle within 16. There the polynomials
  // of both sides differ by the jump and twice the slope times the distance.
  const double miss = cut_error_ + 0x1p-98 * arc.circle.radius, thick = 16 * miss;
  const double beyond = 2 * kernel_.slope_max() * thick + 2 * kernel_.k_error();
  const double x = arc.upright ? other : run, y = arc.upright ? run : other;
  if (kernel_.near_knot(found.px, x, miss)) error_ += 2 * half * thick * (found.x.jump + beyond) * kernel_.k_max();
  if (kernel_.near_knot(found.py, y, miss)) error_ += 2 * thick * (found.y.jump + beyond) * kernel_.K_max();
  return found;
}

void BoundaryIntegral::add_arc_piece(const Arc& arc, bool tiny, double from, double to, int depth) {
  const double mid = 0.5 * (from + to), half = 0.5 * (to - from);
  const double r = kernel_.radius(), radius = arc.circle.radius;
  const ArcMiddle middle(arc, mid);
  const Cell in = arc_cell(arc, tiny, middle, half);
  const int px = in.px, py = in.py;
  // Walking order: the circle goes from +x towards +y, so y grows on the right quarter and x shrinks on the lower one.
  const double direction = arc.upright ? arc.side : -arc.side;
  const double miss = cut_error_ + 0x1p-98 * radius;
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
  const auto piece_half = [&](int p) { return p < 0 || p >= kernel_.pieces() ? HUGE_VAL : kernel_.half_length(p); };
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
    const double rho_run = ellipse_of_disk(reach / piece_half(arc.upright ? py : px));
    const double rho_other = ellipse_of_disk(reach_other / piece_half(arc.upright ? px : py));
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
      K[i] = delta_K(arc.circle, arc.upright ? p.offset : p.relative);
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
  if (tiny) {
    // The term's error, relative to its scale: k to k_error(), the centred integral to that and 64 roundings, the point
    // to 8 roundings of the radius; positions of knots likewise.
    const double k_relative = kernel_.k_error() / kernel_.k_max();
    error_ += length * scale * (3 * k_relative + 64 * kUnit) +
              length * radius * kernel_.k_max() * kernel_.slope_max() * (8 * kUnit * radius + cut_error_);
    return;
  }
  travel *= half;
  // arc.h; and 2 u half for the node itself, which is as good as another point of the circle. |coordinate| <= 1.01 W.
  const double place = kUnit * (1.01 * r + 11 * half) + 0x1p-98 * radius;
  // The slope of the lower and upper quarters errs by 6 u |dv| besides 9 u of itself.
  error_ +=
      travel * (in.y.k * (in.x.K_error_at_x + in.x.k * place) + in.x.K * (in.y.k_error_at_x + in.y.slope * place) +
                kUnit * (nodes + 20) * in.x.K * in.y.k + miss * wrong_x * in.y.k) +
      6 * kUnit * length * in.x.K * in.y.k;
  // Where the curve passes a knot of y, at an end or without having been cut there, k is wrong over at most `miss`.
  if (wrong_y * in.x.K < 0x1p-40) {
    error_ += 4 * miss * wrong_y * in.x.K;
    return;
  }
  const auto passes = [&](double y) { return kernel_.near_knot(py, y, 4 * miss); };
  const auto y_at = [&](double tau) { return arc.upright ? middle.at(tau).run : middle.at(tau).other; };
  const bool touches = !arc.upright && passes(arc.c_other + arc.side * radius);
  error_ += (passes(y_at(-half)) + passes(y_at(half)) + 2 * touches) * miss * wrong_y * in.x.K;
}

}  // namespace moire
