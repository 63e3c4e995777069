// Errors are counted as in boundary_integral.cpp. J is computed point by point from its own stretches; J' denotes the
// analytic function that a piece's stretches, taken from one point, stand for. The remainder is that of J'. J and J'
// differ where a piece reaches beyond the line of a cut: add_wrong_sides().
#include "engine/swept_integral.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <iterator>

#include "core/rounding.h"
#include "curve/quadrature.h"

namespace moire {
namespace {

// Quadrature remainders are pushed below this share of the integrand's scale: well under rounding.
constexpr double kRemainder = 0x1p-57;
constexpr int kMostNodes = 20;
constexpr int kMostHalvings = 40;

double half_of_shortest(const Kernel& kernel) {
  double least = HUGE_VAL;
  for (int p = 0; p < kernel.pieces(); ++p) least = std::min(least, kernel.half_length(p));
  return least;
}

// Bounds of k and K on pieces continued by `beyond`.
double widest_k(const Kernel& kernel, double beyond) {
  double top = 0;
  for (int p = 0; p < kernel.pieces(); ++p) {
    top = std::max(top, kernel.k_on_ellipse(p, ellipse_of_disk(beyond / kernel.half_length(p))));
  }
  return top;
}

double widest_K(const Kernel& kernel, double beyond) {
  double top = 1;
  for (int p = 0; p < kernel.pieces(); ++p) {
    top = std::max(top, kernel.K_on_ellipse(p, ellipse_of_disk(beyond / kernel.half_length(p))));
  }
  return top;
}

// A component of the motion counts where its cuts, which miss by up to 160 u of the reach (ArcTrack::miss()), last for
// no longer than 1 / 8 of the time; and where polynomials stay below 1000 on paths that go on, in a piece that is on
// the wrong side of a line by 16 times that, for as long as it takes. Motions of like components are far above both.
Vec2 counting(const Kernel& kernel, Vec2 motion) {
  const double miss = 160 * kUnit * SweptGrid{kernel, motion}.reach();
  const auto counts = [&](double d, double other) {
    if (std::fabs(d) < 8 * miss) return false;
    const double beyond = 16 * miss * std::fabs(other / d);
    return beyond < 0x1p-20 * kernel.radius() || std::max(widest_k(kernel, beyond), widest_K(kernel, beyond)) < 1000;
  };
  return {counts(motion.x, motion.y) ? motion.x : 0, counts(motion.y, motion.x) ? motion.y : 0};
}

}  // namespace

SweptIntegral::SweptIntegral(const Kernel& kernel, Vec2 motion)
    : kernel_(kernel),
      path_(kernel, counting(kernel, motion)),
      grid_{kernel, path_.motion()},
      reach_(grid_.reach()),
      shortest_(half_of_shortest(kernel)) {
  assert(kernel.pieces() <= kMaxPieces);
  // Moving any set by s in x changes its value by at most |s| times the total variation of k in x and the integral of
  // |k| in y. Left out of a motion, s is half a component on the average over time, and its size does not exceed it.
  double variation = 0, area = 0;
  for (int p = 0; p < kernel.pieces(); ++p) {
    const double half = kernel.half_length(p);
    variation += 2 * half * kernel.bounds(p).slope + path_.jump(p);
    area += 2 * half * kernel.bounds(p).k;
  }
  variation += path_.jump(kernel.pieces());
  const double left_out = std::fabs(motion.x - path_.motion().x) + std::fabs(motion.y - path_.motion().y);
  motion_error_ = 0.51 * left_out * variation * area;
}

void SweptIntegral::reset() {
  sum_ = {};
  error_ = 0;
}

double SweptIntegral::bound() const {
  return (error_ + 2 * kUnit * std::fabs(value())) * (1 + 0x1p-20);  // the bound's own rounding
}

// A place that is off by `thick` across a knot's line is off by thick / |d| in time, and the other coordinate goes on
// for as long.
SweptIntegral::Margin SweptIntegral::margin(double thick) const {
  const Vec2 d{std::fabs(grid_.motion.x), std::fabs(grid_.motion.y)};
  return {thick, widest_k(kernel_, thick + (d.x > 0 ? thick * d.y / d.x : 0)),
          widest_K(kernel_, thick + (d.y > 0 ? thick * d.x / d.y : 0))};
}

void SweptIntegral::add(const Segment& s) {
  if (s.a.y == s.b.y && s.doubt == 0) return;
  // An end that is off by the doubt changes dy, too.
  error_ += 2 * s.doubt * std::fabs(s.weight) * kernel_.K_max() * kernel_.k_max();
  add_track(SegmentTrack(s), SegmentTrack::miss(grid_, s));
}

void SweptIntegral::add(const Circle& circle) {
  const bool near = circle.radius <= 4 * reach_;
  const Rect window = grid_.window();
  for (const Quarter which : {Quarter::left, Quarter::upper, Quarter::right, Quarter::lower}) {
    const Rect place = around(circle, which);
    if (place.hi.y < window.lo.y || place.lo.y > window.hi.y || place.hi.x < window.lo.x) continue;
    const Arc arc = quarter(circle, which, near);
    add_track(ArcTrack(arc), ArcTrack::miss(grid_, arc));
    // The gap between two quarters (arc.h): half of it for each.
    for (const double end : {arc.v0, arc.v1}) {
      if (std::fabs(arc.run(end)) > 1.01 * reach_ || std::fabs(arc.other(end)) > 1.01 * reach_) continue;
      const double gap = kUnit * (near ? 1.07 * circle.radius : 1.01 * reach_);
      error_ += 0.5 * gap * kernel_.K_max() * kernel_.k_max();
    }
  }
}

template <class Track>
void SweptIntegral::add_track(const Track& track, double miss) {
  track.cut(grid_, cuts_);
  if (cuts_.empty()) return;
  miss_ = miss;
  plain_ = margin(miss);
  close_ = margin(16 * miss);
  for (std::size_t i = 0; i + 1 < cuts_.size(); ++i) add_piece(track, cuts_[i], cuts_[i + 1], 0);
}

// Whether the first or last point of the path from p is within `distance` of a knot's line, or the path of a corner.
// `stretches_` are its.
bool SweptIntegral::near_line(Vec2 p, double distance) const {
  const Vec2 d = grid_.motion;
  for (const double at : {p.x, p.x + d.x, p.y, p.y + d.y}) {
    if (kernel_.near_knot(kernel_.piece_of(at), at, distance)) return true;
  }
  if (d.x == 0 || d.y == 0) return false;
  // Between two cuts of different kinds the path runs beside a corner; its distance from there is that far across.
  const double across = std::fabs(d.x) * std::fabs(d.y) / std::hypot(d.x, d.y);
  for (const SweptPath::Stretch& s : stretches_) {
    const bool beside = s.first != SweptPath::Cut::time && s.last != SweptPath::Cut::time && s.first != s.last;
    if (beside && (s.t1 - s.t0) * across <= distance) return true;
  }
  return false;
}

double SweptIntegral::seen() const {
  const double dy = std::fabs(grid_.motion.y), width = 2.01 * kernel_.radius();
  return dy > width ? width / dy : 1;
}

// What J and J' may differ by on a piece: its integral and its sum over the nodes. `travel` is the piece's |dy|.
//  - First or last point beyond a knot of x: for thick / |dx| in time (all the time when dx = 0), by what the
//    polynomials of K on both sides differ, the jump of k times the distance and a little; they agree at the knot.
//  - The same for y, where k itself differs. That part of the piece is at most thick in dy, on each side of an extreme
//    point. At nodes SweptPath::mean() has counted it; where dy = 0, J is evaluated as J'.
//  - The path on the wrong side of a corner: for `late` in time two cuts are in the wrong order. What is wrong then is
//    the product of the differences in x and in y.
void SweptIntegral::add_wrong_sides(const Rect& extent, double travel, bool straight, const Margin& m) {
  const Vec2 d = grid_.motion, size{std::fabs(d.x), std::fabs(d.y)};
  const auto knots = kernel_.knots();
  const double k_slope = 2.02 * kernel_.slope_max(), k_error = 2 * kernel_.k_error(), K_error = 2 * kernel_.K_error();
  const auto each_near = [&](double lo, double hi, auto&& f) {
    const auto first = std::lower_bound(knots.begin(), knots.end(), lo - m.thick);
    for (auto k = first; k != knots.end() && *k <= hi + m.thick; ++k)
      f(path_.jump(static_cast<int>(k - knots.begin())));
  };
  const double time_x = size.x > 0 ? m.thick / size.x : 1, time_y = size.y > 0 ? m.thick / size.y : 1;
  // Where the boundary is straight, no more of the piece is beyond the line than its share of the way in x.
  const double part = straight ? std::min(1.0, 2 * m.thick / (extent.hi.x - extent.lo.x)) : 1;
  const auto wrong_x = [&](double jump) {
    const double wrong = (jump + k_slope * m.thick) * m.thick + K_error;
    error_ += 2 * travel * part * (size.x > 0 ? time_x * m.k_top : seen() * kernel_.k_max()) * wrong;
  };
  const auto wrong_y = [&](double jump) {
    error_ += std::min(travel, 2 * m.thick) * time_y * (jump + k_slope * m.thick + k_error) * m.K_top;
  };
  each_near(extent.lo.x, extent.hi.x, wrong_x);
  each_near(extent.lo.y, extent.hi.y, wrong_y);
  if (d.x != 0) each_near(extent.lo.x + d.x, extent.hi.x + d.x, wrong_x);
  if (d.y != 0) each_near(extent.lo.y + d.y, extent.hi.y + d.y, wrong_y);
  if (d.x == 0 || d.y == 0) return;
  double x_cuts = 0, y_cuts = 0;
  for (const SweptPath::Stretch& s : stretches_) {
    x_cuts += s.last == SweptPath::Cut::x_knot;
    y_cuts += s.last == SweptPath::Cut::y_knot;
  }
  if (x_cuts == 0 || y_cuts == 0) return;
  const double late = m.thick * std::hypot(d.x, d.y) / (size.x * size.y);
  const Vec2 beyond{size.x * late, size.y * late};
  // Beyond its end by a share s of its half length a polynomial of degree n is at most T_n(1 + s) < 1 + 1.01 n^2 s
  // times larger than on its piece, while that is small; so is its slope.
  const double n = kernel_.degree() + 1;
  const auto little = [&](double distance) { return distance * n * n <= 0x1p-7 * shortest_; };
  const double jump = 1.01 * kernel_.jump_max();
  const double K =
      little(beyond.x) ? (jump + k_slope * beyond.x) * beyond.x + K_error : 2 * widest_K(kernel_, beyond.x);
  const double k = little(beyond.y) ? jump + k_slope * beyond.y + k_error : 2 * widest_k(kernel_, beyond.y);
  error_ += x_cuts * y_cuts * 2 * travel * late * K * k;
}

// A piece right of the support at all times: the integral of the mean of k(y), by its antiderivative.
template <class Track>
void SweptIntegral::add_right(const Track& track, double from, double to, const Rect& extent, const Margin& m) {
  // Inside the window both ends are known to their rounding; one that is farther out is its neighbour's, too.
  const double off = track.off(grid_, 0);
  const SweptPath::Mean a = path_.mean_K(track.y(from), off), b = path_.mean_K(track.y(to), off);
  const double weight = track.direction();
  sum_.add(weight * (b.value - a.value));
  error_ += std::fabs(weight) * (a.error + b.error + 4 * kUnit * (a.top + b.top));
  // It may reach into the support in x, for as long as that takes, or for good.
  const Rect window = grid_.window();
  if (extent.lo.x > window.hi.x + m.thick) return;
  const double travel = std::min(2 * (extent.hi.y - extent.lo.y), window.hi.y - window.lo.y);
  const double time = grid_.motion.x == 0 ? seen() : std::min(1.0, m.thick / std::fabs(grid_.motion.x));
  const double part = track.degree(kernel_) < 0 ? 1 : std::min(1.0, m.thick / (extent.hi.x - extent.lo.x));
  const double wrong = (kernel_.jump_max() + 2 * kernel_.slope_max() * m.thick) * m.thick + 2 * kernel_.K_error();
  error_ += std::fabs(weight) * travel * part * time * wrong * kernel_.k_max();
}

template <class Track>
void SweptIntegral::add_piece(const Track& track, double from, double to, int depth) {
  const typename Track::Piece piece(track, from, to);
  const double half = 0.5 * (to - from), weight = std::fabs(track.direction());
  const TrackPoint first = piece.at(-half), middle = piece.at(0), last = piece.at(half);
  // The mean of three points stands for the piece. The lines of the cuts are straight: on each side that the mean is
  // on, so is the piece, up to `miss`; when the mean is within 2 `miss` of a line, up to 16 times that, as the three
  // points are on one side up to `miss`, so within 11 times that, and the curve between them is near a parabola.
  const Vec2 mean{0.5 * middle.at.x + 0.25 * (first.at.x + last.at.x),
                  0.5 * middle.at.y + 0.25 * (first.at.y + last.at.y)};
  path_.split(mean, stretches_);
  const int pieces = kernel_.pieces();
  bool counts = false, right = true;
  for (const SweptPath::Stretch& s : stretches_) {
    counts |= s.counts(pieces);
    right &= s.px >= pieces;
  }
  const bool close = near_line(mean, 2 * miss_);
  const Margin& m = close ? close_ : plain_;
  const Rect extent = piece.extent();
  if (right) return add_right(track, from, to, extent, m);
  if (depth == 0 || close) {
    // An extreme point makes it twice the extent.
    const double travel = std::min(2 * (extent.hi.y - extent.lo.y), 4 * reach_) * weight;
    add_wrong_sides(extent, travel, track.degree(kernel_) >= 0, m);
  }
  if (!counts) return;

  // Remainder of J'. The middle is not the point that the stretches were taken from.
  const int exact = track.degree(kernel_) < 0 ? kMaxNodes + 1 : track.degree(kernel_) / 2 + 1;
  const double scale = kernel_.k_max();
  int nodes = exact <= kMostNodes ? exact : 0;
  double remainder = nodes > 0 ? 0 : HUGE_VAL;
  for (std::size_t i = 0; i < std::size(kEllipses) && nodes != 4 && (nodes == 0 || nodes > 6); ++i) {
    const double rho = kEllipses[i];
    const std::optional<TrackDisk> disk = piece.disk(half * (rho + 1 / rho) / 2);
    if (!disk) break;
    const double room = 4 * miss_;  // for all roundings of places
    const Vec2 reach{disk->reach.x + std::fabs(middle.at.x - mean.x) + room,
                     disk->reach.y + std::fabs(middle.at.y - mean.y) + room};
    const double bound = path_.top(stretches_, reach) * disk->rise;
    for (int n = 4; n <= kMostNodes; n += 2) {
      if (nodes != 0 && n >= nodes) break;
      const double share = gauss_remainder(i, n) * bound * half;
      if (!(share <= kRemainder * scale * half)) continue;
      nodes = n;
      remainder = share;
    }
  }
  if (nodes == 0) {
    if (depth < kMostHalvings) {
      const double mid = 0.5 * (from + to);
      add_piece(track, from, mid, depth + 1);
      add_piece(track, mid, to, depth + 1);
      return;
    }
    nodes = kMostNodes;  // a piece 2^-40 of a curve: its whole contribution is the bound
    remainder = 4 * half * kernel_.K_max() * kernel_.k_max();
  }

  const Rule rule = gauss_legendre(nodes);
  const double off = track.off(grid_, half);
  const int py = stretches_.front().py;
  double sum = 0, error = 0;
  for (std::size_t i = 0; i < rule.node.size(); ++i) {
    const TrackPoint p = piece.at(half * rule.node[i]);
    const SweptPath::Mean J = path_.mean(p.at, py, {off, m.thick, m.K_top});
    const double share = rule.weight[i] * p.rise;
    sum += share * J.value;
    // A slope to 9 u, and 6 u |dv| where it is small (arc.h); weights and products to 6 u, the sum to n u.
    error += std::fabs(share) * (J.error + kUnit * (nodes + 20) * J.top) + 6 * kUnit * rule.weight[i] * J.top;
  }
  sum_.add(track.direction() * half * sum);
  error_ += weight * (half * error + remainder);
}

}  // namespace moire
