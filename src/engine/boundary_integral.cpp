// u = 2^-53 throughout. Errors of one term w K(x) k(y) h of a quadrature sum, h half the piece's extent in y:
//  - K and k as functions: K_error(), k_error() (fit, coefficients, evaluation);
//  - the point (x, y): off its curve by at most position_error_, which moves K by k_max and k by slope_max times that;
//  - weight, h and the products: below 8 u of the term.
// Weights add up to 2, so their sum is at most per_length_ times the piece's |dy|. Terms are added with compensation.
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
constexpr double kRhos[] = {1.5, 2.0, 2.5, 3.0, 4.0, 6.0, 8.0, 12.0, 20.0, 40.0};

constexpr int kMostNodes = 20;

// (64 / 15) rho^-2n / (1 - rho^-2), see quadrature.h, for rho = kRhos[r].
double gauss_factor(std::size_t r, int n) {
  struct Table {
    double factor[std::size(kRhos)][kMostNodes + 1];
    Table() {
      for (std::size_t i = 0; i < std::size(kRhos); ++i) {
        for (int j = 0; j <= kMostNodes; ++j) {
          factor[i][j] = 64.0 / 15 * std::pow(kRhos[i], -2 * j) / (1 - 1 / (kRhos[i] * kRhos[i]));
        }
      }
    }
  };
  static const Table table;
  return table.factor[r][n];
}

// Parameter of the Bernstein ellipse around [-1, 1] that holds every disk of radius r around a point of [-1, 1]:
// |z - 1| + |z + 1| <= 2 + 2 r on the disk, and it is rho + 1 / rho on the ellipse.
double ellipse_of_disk(double r) { return 1 + r + std::sqrt(r * (r + 2)); }

}  // namespace

BoundaryIntegral::BoundaryIntegral(const Kernel& kernel) : kernel_(kernel) {
  // On a straight piece inside one knot cell K(x(s)) k(y(s)) is a polynomial of degree 2 d + 1: d + 1 nodes are exact.
  // For high degrees fewer nodes do: x and y stay in the ellipse of their knot interval when s is in that of the piece.
  line_nodes_ = kernel.degree() + 1;
  line_remainder_ = 0;
  if (kernel.degree() >= 6) {
    for (int n = 4; n < line_nodes_ && n <= kMostNodes; ++n) {
      double best = HUGE_VAL;
      for (std::size_t i = 0; i < std::size(kRhos); ++i) {
        double k_bound = 0, K_bound = 0;
        for (int p = 0; p < kernel.pieces(); ++p) {
          k_bound = std::max(k_bound, kernel.k_on_ellipse(p, kRhos[i]));
          K_bound = std::max(K_bound, kernel.K_on_ellipse(p, kRhos[i]));
        }
        best = std::min(best, gauss_factor(i, n) * k_bound * K_bound / 2);
      }
      if (best <= kRemainder * kernel.k_max()) {
        line_nodes_ = n;
        line_remainder_ = best;
      }
    }
  }
  // Straight: two roundings each in the parameter and in the point. Arcs: see add_arc_piece.
  position_error_ = 24 * kUnit * kernel.radius();
  per_length_ = kernel.k_max() * (kernel.K_error() + kernel.k_max() * position_error_) +
                kernel.K_max() * (kernel.k_error() + kernel.slope_max() * position_error_) +
                8 * kUnit * kernel.k_max() * kernel.K_max() + line_remainder_;
  // Between a knot and a cut that misses it the neighbour's polynomial is used, over at most position_error_ in y: k is
  // off by its jump there (0 but for rounding at most knots), K is continuous.
  per_cut_ = kernel.K_max() * position_error_ *
             (kernel.jump_max() + 2 * kernel.k_error() + 2 * kernel.slope_max() * position_error_);
}

void BoundaryIntegral::reset() {
  sum_ = {};
  length_ = other_ = 0;
  cuts_made_ = 0;
}

double BoundaryIntegral::bound() const {
  const double sum = per_length_ * length_ + per_cut_ * cuts_made_ + other_ + 2 * kUnit * std::fabs(value());
  return sum * (1 + 0x1p-20);  // the bound's own rounding
}

// The integral of k(y) dy from y0 to y1, where K(x) = 1.
void BoundaryIntegral::add_closed_form(double weight, double y0, double y1) {
  sum_.add(weight * (kernel_.K(y1) - kernel_.K(y0)));
  other_ += std::fabs(weight) * (2 * kernel_.K_error() + 2 * kUnit);
}

void BoundaryIntegral::add(const Segment& s) {
  const double dx = s.b.x - s.a.x, dy = s.b.y - s.a.y;
  const double r = kernel_.radius();
  if (dy == 0 || std::min(s.a.y, s.b.y) >= r || std::max(s.a.y, s.b.y) <= -r || std::max(s.a.x, s.b.x) <= -r) return;
  if (std::min(s.a.x, s.b.x) >= r) return add_closed_form(s.weight, s.a.y, s.b.y);
  cuts_.assign({0.0, 1.0});
  for (const double knot : kernel_.knots()) {
    const double along_y = (knot - s.a.y) / dy;
    if (along_y > 0 && along_y < 1) cuts_.push_back(along_y);
    if (dx == 0) continue;
    const double along_x = (knot - s.a.x) / dx;
    if (along_x > 0 && along_x < 1) cuts_.push_back(along_x);
  }
  std::sort(cuts_.begin(), cuts_.end());
  for (std::size_t i = 0; i + 1 < cuts_.size(); ++i) {
    if (cuts_[i] < cuts_[i + 1]) add_segment_piece(s, cuts_[i], cuts_[i + 1]);
  }
  cuts_made_ += static_cast<int>(cuts_.size()) - 2;
}

void BoundaryIntegral::add_segment_piece(const Segment& s, double from, double to) {
  const double dx = s.b.x - s.a.x, dy = s.b.y - s.a.y;
  const double mid = 0.5 * (from + to), half = 0.5 * (to - from);
  // Classified by the midpoint: the ends lie on knots only up to rounding.
  const int px = kernel_.piece_of(s.a.x + mid * dx), py = kernel_.piece_of(s.a.y + mid * dy);
  // A piece as short as rounding may lie on either side of a knot that it begins at.
  if (std::fabs(half * dy) <= position_error_) {
    other_ += 2 * std::fabs(s.weight * half * dy) * kernel_.k_max() * kernel_.K_max();
  }
  if (px < 0 || py < 0 || py >= kernel_.pieces()) return;
  if (px >= kernel_.pieces()) return add_closed_form(s.weight, s.a.y + from * dy, s.a.y + to * dy);
  const Rule rule = gauss_legendre(line_nodes_);
  double sum = 0;
  for (std::size_t i = 0; i < rule.node.size(); ++i) {
    const double at = mid + half * rule.node[i];
    sum += rule.weight[i] * kernel_.K_piece(px, s.a.x + at * dx) * kernel_.k_piece(py, s.a.y + at * dy);
  }
  sum_.add(s.weight * half * dy * sum);
  length_ += std::fabs(s.weight * half * dy) * 2;
  // The plain sum over at most 24 nodes: node count times u of the absolute terms.
  other_ += kUnit * line_nodes_ * std::fabs(s.weight * half * dy) * 2 * kernel_.k_max() * kernel_.K_max();
}

// A quarter of a circle, 45 degrees to either side of one of its four extreme points, as a function of the coordinate
// that runs along it: y on the right and left quarters, x on the upper and lower ones. There the slope is at most 1 and
// the circle is far from the square-root singularity at its ends.
//
// Two ways to the other coordinate, both free of cancellation:
//  - near (R <= 4 W, W the filter's radius): v runs relative to the circle's centre, other = c + side sqrt((R-v)(R+v)).
//    Coordinates are at most R + sqrt(2) W < 6 W, four roundings: below 24 u W.
//  - far: v runs relative to the pixel's centre, and other solves a^2 - 2 c a + q = 0 with q = v^2 - 2 c_v v - power:
//    the root of larger magnitude by the formula, the other one as q over it. q errs by at most
//    u (3 v^2 + 4 |c_v v| + 3 |power|), where a circle that meets the window has |power| <= sqrt(2) W (2 R + sqrt(2) W)
//    and |c_v| <= R + W: below u (13 W^2 + 12.5 R W) < 16 u R W. Where the root lies in the window, the denominator is
//    at least sqrt(2) R - W > 1.1 R: below 16 u W, and 4 u W for the division and the square root.
struct BoundaryIntegral::ArcFrame {
  const Circle& circle;
  bool upright;  // y runs (right and left quarters)
  double side;   // +1: right or lower (towards +x, +y), -1: left or upper
  bool near;
  bool tiny;  // the antiderivative is taken from the circle's centre: see add(const Circle&)
  double c_run, c_other, rest_run, rest_other;
  // Where the quarter begins and ends, with the other coordinate there, shared with its neighbours bit for bit.
  double v0, v1, other0, other1;

  double run(double v) const { return near ? c_run + v : v; }
  double relative(double v) const { return near ? v : v - c_run; }  // to the circle's centre
  double offset(double v) const {                                   // other coordinate relative to the centre
    const double beta = relative(v);
    return side * std::sqrt(std::max(0.0, (circle.radius - beta) * (circle.radius + beta)));
  }
  double other(double v) const {
    if (v == v0) return other0;
    if (v == v1) return other1;
    return other_inside(v);
  }
  double other_inside(double v) const {
    if (near) return c_other + offset(v);
    const double q = v * v - 2 * c_run * v - circle.power;
    const double root = std::sqrt(std::max(0.0, c_other * c_other - q));
    if ((side > 0) == (c_other > 0)) return c_other + side * root;
    return q / (c_other - side * root);
  }
};

void BoundaryIntegral::add(const Circle& circle) {
  const double r = kernel_.radius(), radius = circle.radius;
  // Near, and tiny: K(x) may be replaced by the integral of k from the circle's centre to x, since k(y) dy integrates
  // to nothing around a closed curve. Both factors then shrink with the circle, and so does the error: relative
  // accuracy holds down to any radius.
  const bool near = radius <= 4 * r, tiny = radius <= r / 8;
  const double leg = radius * 0.70710678118654752440;
  // The four corners between quarters, each computed once, so that neighbouring quarters meet exactly.
  struct Corner {
    double x, y;  // as the quarters count: relative to the circle's centre when near, else to the pixel's
  } corner[2][2];
  for (int sx = 0; sx < 2; ++sx) {
    for (int sy = 0; sy < 2; ++sy) {
      const ArcFrame arc{circle, true, sx == 0 ? -1.0 : 1.0, near, tiny, circle.center.y, circle.center.x, 0, 0, 0, 0,
                         0,      0};
      const double y = (near ? 0 : circle.center.y) + (sy == 0 ? -leg : leg);
      corner[sx][sy] = {near ? arc.offset(y) : arc.other_inside(y), y};
    }
  }
  const Vec2 c = circle.center, rest = circle.center_rest;
  const auto x_of = [&](const Corner& k) { return near ? c.x + k.x : k.x; };
  const auto y_of = [&](const Corner& k) { return near ? c.y + k.y : k.y; };
  for (int s = 0; s < 2; ++s) {
    const double side = s == 0 ? -1.0 : 1.0;
    const Corner &upper = corner[s][0], &lower = corner[s][1], &left = corner[0][s], &right = corner[1][s];
    add_arc({circle, true, side, near, tiny, c.y, c.x, rest.y, rest.x, upper.y, lower.y, x_of(upper), x_of(lower)});
    add_arc({circle, false, side, near, tiny, c.x, c.y, rest.x, rest.y, left.x, right.x, y_of(left), y_of(right)});
  }
}

void BoundaryIntegral::add_arc(const ArcFrame& arc) {
  const double r = kernel_.radius(), radius = arc.circle.radius;
  // Knots relative to where v counts from; exact to the last bit that matters for tiny circles.
  const auto run_knot = [&](double knot) { return arc.near ? (knot - arc.c_run) - arc.rest_run : knot; };
  double from = std::max(arc.v0, run_knot(-r)), to = arc.v1;
  if (arc.upright) to = std::min(to, run_knot(r));
  if (arc.tiny && !arc.upright) from = arc.v0;  // the centred antiderivative does not vanish left of the support
  if (!(from < to)) return;
  cuts_.assign({from, to});
  // Right of the support nothing may be cut: there a piece counts by its ends alone, and far out on a large circle
  // these are not known well enough to tell K(y) = 0 from a little more.
  const double last_cut = arc.upright || arc.tiny ? to : std::min(to, run_knot(r));
  const auto cut = [&](double v) {
    if (v > from && v <= last_cut && v < to) cuts_.push_back(v);
  };
  for (const double knot : kernel_.knots()) {
    cut(run_knot(knot));
    // Where the other coordinate passes the knot, on this side of the circle.
    const double gap = (knot - arc.c_other) - arc.rest_other;
    if (arc.near) {
      if (gap * arc.side < 0 || std::fabs(gap) > radius) continue;
      const double beta = std::sqrt((radius - gap) * (radius + gap));
      cut(beta);
      cut(-beta);
    } else if (gap * arc.side >= 0) {
      const double q = knot * knot - 2 * arc.c_other * knot - arc.circle.power;
      const double discriminant = arc.c_run * arc.c_run - q;
      if (discriminant < 0) continue;
      const double large = arc.c_run + std::copysign(std::sqrt(discriminant), arc.c_run);
      cut(large);
      if (large != 0) cut(q / large);
    }
  }
  std::sort(cuts_.begin(), cuts_.end());
  if (arc.tiny) {
    // Positions relative to the centre are right to 8 u of the radius.
    other_ += 8 * kUnit * radius * radius * kernel_.k_max() * kernel_.k_max() * static_cast<double>(cuts_.size());
  } else {
    cuts_made_ += static_cast<int>(cuts_.size());
  }
  for (std::size_t i = 0; i + 1 < cuts_.size(); ++i) {
    if (cuts_[i] < cuts_[i + 1]) add_arc_piece(arc, cuts_[i], cuts_[i + 1], 0);
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

void BoundaryIntegral::add_arc_piece(const ArcFrame& arc, double from, double to, int depth) {
  const double mid = 0.5 * (from + to), half = 0.5 * (to - from);
  const double run_mid = arc.run(mid), other_mid = arc.other_inside(mid);
  const double x_mid = arc.upright ? other_mid : run_mid, y_mid = arc.upright ? run_mid : other_mid;
  // Tiny circles can be smaller than an ulp of where they are: their pieces are told apart relative to the centre, as
  // their cuts were made.
  const auto piece_of = [&](bool running, double position) {
    if (!arc.tiny) return kernel_.piece_of(position);
    const double relative = running ? mid : arc.offset(mid);
    const double c = running ? arc.c_run : arc.c_other, rest = running ? arc.rest_run : arc.rest_other;
    int p = -1;
    for (const double knot : kernel_.knots()) p += (knot - c) - rest <= relative;
    return p;
  };
  const int px = piece_of(!arc.upright, x_mid), py = piece_of(arc.upright, y_mid);
  // Walking order: the circle goes from +x towards +y, so y grows on the right quarter and x shrinks on the lower one.
  const double direction = arc.upright ? arc.side : -arc.side;
  const double radius = arc.circle.radius;
  // Far circles: the power is right to 2^-98 R^2 and an ulp (boundary.h); the first moves the curve by that over 2 R.
  const double position = position_error_ + (arc.near ? 0 : 0x1p-98 * radius);
  if (!arc.tiny) {
    if (px < 0) return;
    if (px >= kernel_.pieces()) {
      const double y0 = arc.upright ? arc.run(from) : arc.other(from), y1 = arc.upright ? arc.run(to) : arc.other(to);
      return add_closed_form(direction, y0, y1);
    }
  }
  if (py < 0 || py >= kernel_.pieces()) return;

  // Remainder: v in the ellipse rho around the piece is at most `reach` from its middle. There |v - centre| <= e R, so
  // that |d other / d v| <= e / sqrt(1 - e^2), and the other coordinate stays in a disk around other_mid.
  const double middle = std::fabs(arc.relative(mid)) / radius;
  const auto piece_half = [&](int p) { return p < 0 || p >= kernel_.pieces() ? HUGE_VAL : kernel_.half_length(p); };
  const double scale = arc.tiny ? radius * kernel_.k_max() * kernel_.k_max() : kernel_.k_max();
  int nodes = 0;
  double remainder = HUGE_VAL;
  for (std::size_t i = 0; i < std::size(kRhos); ++i) {
    const double rho = kRhos[i];
    const double reach = half * (rho + 1 / rho) / 2;
    const double e = middle + reach / radius;
    if (e > 0.96) break;
    const double root = std::sqrt((1 - e) * (1 + e));
    const double reach_other = reach * e / root;
    const double rho_run = ellipse_of_disk(reach / piece_half(arc.upright ? py : px));
    const double rho_other = ellipse_of_disk(reach_other / piece_half(arc.upright ? px : py));
    const double k_bound = kernel_.k_on_ellipse(py, arc.upright ? rho_run : rho_other);
    double K_bound = 0;
    if (arc.tiny) {
      // The integral of k from the centre to x runs along the real axis to a knot or to the piece's middle, at most R,
      // and from there to x inside the disk around other_mid or the ellipse: at most sqrt(2) R + R, |x - centre| <=
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
      const double r = gauss_factor(i, n) * bound * half;
      if (r > kRemainder * scale * half) continue;
      nodes = n;
      remainder = r;
    }
  }
  if (nodes == 0) {
    if (depth < 40) {
      add_arc_piece(arc, from, mid, depth + 1);
      add_arc_piece(arc, mid, to, depth + 1);
      return;
    }
    nodes = kMostNodes;  // a piece 2^-40 of a quarter: its whole contribution is the bound
    remainder = 4 * half * scale;
  }

  const Rule rule = gauss_legendre(nodes);
  double sum = 0;
  for (std::size_t i = 0; i < rule.node.size(); ++i) {
    const double v = mid + half * rule.node[i];
    const double run = arc.run(v), offset = arc.offset(v);
    const double other = arc.other_inside(v);
    const double x = arc.upright ? other : run, y = arc.upright ? run : other;
    const double K = arc.tiny ? delta_K(arc.circle, arc.upright ? offset : v) : kernel_.K_piece(px, x);
    // dy = -(x - centre) / (y - centre) dx on the upper and lower quarters.
    const double slope = arc.upright ? 1.0 : -arc.relative(v) / offset;
    sum += rule.weight[i] * K * kernel_.k_piece(py, y) * slope;
  }
  sum_.add(direction * half * sum);
  other_ += remainder;
  const double length = 2 * half;  // |dy| <= |dv| on every quarter
  if (arc.tiny) {
    // The term's error, relative to its scale: k to k_error(), the centred integral to that and 64 roundings, the point
    // to 8 roundings of the radius; positions of knots likewise.
    const double k_relative = kernel_.k_error() / kernel_.k_max();
    other_ += length * scale * (3 * k_relative + 64 * kUnit) +
              length * radius * kernel_.k_max() * kernel_.slope_max() * (8 * kUnit * radius + position);
  } else {
    length_ += length;
    other_ += kUnit * (nodes + 8) * length * kernel_.k_max() * kernel_.K_max();
    const double farther = position - position_error_;
    other_ += farther * (length * (kernel_.k_max() * kernel_.k_max() + kernel_.K_max() * kernel_.slope_max()) +
                         2 * kernel_.K_max() * kernel_.jump_max());
  }
}

}  // namespace moire
