// u = 2^-53 throughout. Errors of one term w q(r) rise h of a quadrature sum, h half the piece's extent in the chord:
//  - q as a function: q_error of its piece;
//  - r, where it errs by the share e: since r q' = k - 2 q, that moves q by at most |k - 2 q| e, and by the jump of k
//    times e where r is so near a knot that rounding may pass it. r is put back into its piece before q is taken;
//  - rise, weight, h and the products: some u of the term's absolute value.
// A node's own place: c errs by 4 u of the end of its piece, and pieces begin at half their end or, where they begin at
// 0, end where r has grown by half: that moves r by at most 8 u. Terms are added with compensation.
#include "engine/radial_integral.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

#include "core/double_double.h"
#include "core/rounding.h"
#include "curve/quadrature.h"

namespace moire {
namespace {

// Each piece of a quadrature may miss this: the integral of the whole kernel is 1.
constexpr double kTarget = 0x1p-60;
constexpr int kMostNodes = 20;
constexpr int kMostHalvings = 60;
// How much r errs at a node, in u: 7 or 14 (radial_track.h), 8 for the node's place, 1 for being put back.
constexpr double kOffNear = 16, kOffFar = 24;

Dd dd_sqrt(Dd x) {
  const double root = std::sqrt(x.hi);
  if (root == 0) return 0.0;
  return quick_two_sum(root, (x - two_prod(root, root)).hi / (2 * root));
}

}  // namespace

void RadialIntegral::reset() {
  sum_ = {};
  error_ = 0;
}

double RadialIntegral::bound() const {
  return (error_ + 2 * kUnit * std::fabs(value())) * (1 + 0x1p-20);  // the bound's own rounding
}

// G(radius) times an angle by its sine and cosine, up to a factor. These are right to 12 u of the factor; the arc
// tangent to 2 u. Over an angle of at most `near_rim` the curve may still be up to 24 u of the radius inside the
// support, where G is short by k r times the distance.
void RadialIntegral::add_angle(double weight, double cross, double dot, double near_rim) {
  const double angle = std::atan2(cross, dot);
  sum_.add(weight * RadialKernel::kWhole * angle);
  error_ += std::fabs(weight) * RadialKernel::kWhole * kUnit * (24 + 6 * std::fabs(angle));
  const RadialKernel::PieceBounds& last = kernel_.bounds(kernel_.pieces() - 1);
  const double r = kernel_.radius();
  error_ += std::fabs(weight) * std::min(std::fabs(angle), near_rim) * 24 * kUnit * r * r * (last.k + last.jump);
}

// The line's distance h and the places s of the ends on it, counted from its nearest point, come from double-double:
// right to 5 u of themselves and `blur`.
void RadialIntegral::add(const Segment& s) {
  const double r = kernel_.radius();
  const Dd dx = two_sum(s.b.x, -s.a.x), dy = two_sum(s.b.y, -s.a.y);
  const double length = std::sqrt(dx.hi * dx.hi + dy.hi * dy.hi);
  const double size = std::fabs(s.a.x) + std::fabs(s.a.y) + std::fabs(s.b.x) + std::fabs(s.b.y);
  // Too short for its square; |q r| <= k_max r / 2 inside, and falls from there on.
  if (length < 0x1p-400) {
    error_ += std::fabs(s.weight) * kernel_.k_max() * r * (length + 0x1p-399);
    return;
  }
  const double cross = (Dd(s.a.x) * dy - Dd(s.a.y) * dx).value();
  const double h = cross / length;
  const double s0 = (Dd(s.a.x) * dx + Dd(s.a.y) * dy).value() / length;
  const double s1 = (Dd(s.b.x) * dx + Dd(s.b.y) * dy).value() / length;

  // What lies between the segment and one whose ends are `off` away: a strip across the support.
  const double blur = 0x1p-98 * size, off = std::numbers::sqrt2 * s.doubt + blur;
  const double inner = std::max(0.0, std::max(s0, -s1));  // from the nearest point of the line to that of the segment
  const double nearest_square = h * h + inner * inner;
  if (nearest_square < (r + off) * (r + off) * (1 + 0x1p-40)) {
    const double across = std::min(length, 2 * (r + off));
    error_ += std::fabs(s.weight) * kernel_.k_max() * 1.01 * off * (across + 2 * off);
  }

  if (cross == 0) return;  // in line with the pixel's centre
  const double reach = std::fabs(h) < r ? std::sqrt((r - std::fabs(h)) * (r + std::fabs(h))) : 0;
  const double from = std::max(s0, -reach), to = std::min(s1, reach);
  // A line is within 24 u of the rim over a chord of less than sqrt(48 u) radii either side.
  if (!(from < to)) return add_angle(s.weight, h * (s1 - s0), h * h + s0 * s1, 0x1p-22);
  if (s0 < from) add_angle(s.weight, h * (from - s0), h * h + s0 * from, 0x1p-22);
  if (s1 > to) add_angle(s.weight, h * (s1 - to), h * h + s1 * to, 0x1p-22);
  const RadialTrack track = RadialTrack::line(h);
  // Ends inside the support, each off by 5 u of its s.
  for (const double end : {s0, s1}) {
    if (std::fabs(end) >= reach) continue;
    const int piece = std::min(kernel_.piece_of(std::sqrt(h * h + end * end)), kernel_.pieces() - 1);
    error_ += 5.1 * kUnit * std::fabs(s.weight * h * end) * kernel_.bounds(piece).q;
  }
  const Along along{track, s.weight, kTarget, kOffNear, false};
  if (from < 0 && to > 0) {
    add_track(along, 0, -from);
    add_track(along, 0, to);
  } else {
    add_track(along, std::min(std::fabs(from), std::fabs(to)), std::max(std::fabs(from), std::fabs(to)));
  }
}

void RadialIntegral::add(const Circle& circle) {
  const double r = kernel_.radius(), radius = circle.radius;
  const Dd cx = two_sum(circle.center.x, circle.center_rest.x), cy = two_sum(circle.center.y, circle.center_rest.y);
  const Dd distance = dd_sqrt(cx * cx + cy * cy);
  // Nearer, q itself loses no more than its floor times D / radius.
  if (distance.hi > 8 * radius && radius <= r / 8) return add_tiny(circle, distance);
  add_halves(circle, distance.value());
}

// Both halves of the circle are alike: mirror images in the line through its centre and the pixel's.
void RadialIntegral::add_halves(const Circle& circle, double distance) {
  const double r = kernel_.radius(), radius = circle.radius, far = distance + radius;
  const double g = circle.power / far;  // right to 5 u and `blur`
  const RadialKernel::PieceBounds& last = kernel_.bounds(kernel_.pieces() - 1);
  if (std::fabs(g) >= r) {
    // Around the support, or beside it; up to 8 u of the radius into it.
    if (g > 0) sum_.add(1);
    error_ += 2 * std::numbers::pi * r * r * 8 * kUnit * (last.k + last.jump) + (g > 0 ? kUnit : 0);
    return;
  }
  const double blur = 0x1p-97 * radius;
  error_ += kernel_.k_max() * blur * 8 * r;
  const double target = kTarget * std::min(1.0, radius * radius * kernel_.k_max());
  const RadialTrack near_track = RadialTrack::from_nearest(g, distance, radius);
  const RadialTrack far_track = RadialTrack::from_farthest(distance, radius);
  const Along nearest{near_track, 2, target, kOffNear, false}, farthest{far_track, 2, target, kOffFar, false};
  // A quarter turn from either end.
  const double quarter = std::numbers::sqrt2 * radius, middle = std::sqrt(distance * distance + radius * radius);
  if (middle > r) {
    const double rim = std::min(quarter, near_track.chord(r));
    add_track(nearest, 0, rim);
    return add_angle(2, near_track.y(rim), -near_track.x(rim), near_track.angle_near(rim, quarter, 24 * kUnit));
  }
  // The quarters meet up to the rounding of their ends, 4 u of the radius, in either half.
  error_ += 8 * kUnit * radius * far * kernel_.bounds(std::min(kernel_.piece_of(middle), kernel_.pieces() - 1)).q;
  add_track(nearest, 0, quarter);
  const double rim = far <= r ? 0 : std::min(quarter, far_track.chord(r));
  add_track(farthest, rim, quarter);
  if (rim > 0) add_angle(2, far_track.y(rim), -far_track.x(rim), far_track.angle_near(rim, 0, 24 * kUnit));
}

// x dy - y dx integrates to twice the area: with q(r) - q(D) in place of q what is left shrinks with the circle.
void RadialIntegral::add_tiny(const Circle& circle, Dd distance) {
  const double r = kernel_.radius(), radius = circle.radius;
  // A distance off by 2^-100 of itself; and a lens that this comparison misses.
  error_ += kernel_.k_max() * (8 * radius * 0x1p-100 * distance.hi + 0x1p-70 * radius * radius);
  if ((distance.hi - r) + distance.lo >= radius) return;
  offset_.place(distance, radius);
  const double twice_area = 2 * std::numbers::pi * radius * radius;
  sum_.add(twice_area * offset_.q_there());
  error_ += twice_area * (kernel_.q_error() + kUnit * kernel_.k_max() * 4);
  const double target = kTarget * radius * radius * kernel_.k_max();
  const double d = distance.hi;
  const RadialTrack near_track = RadialTrack::from_nearest(radius - d, d, radius);
  const RadialTrack far_track = RadialTrack::from_farthest(d, radius);
  const double quarter = std::numbers::sqrt2 * radius;
  // The quarters meet up to the rounding of their ends.
  error_ += 4 * kUnit * radius * (d + radius) * offset_.top();
  add_track({near_track, 2, target, kOffNear, true}, 0, quarter);
  add_track({far_track, 2, target, kOffFar, true}, 0, quarter);
}

// From one chord to another, cut where r passes a knot.
void RadialIntegral::add_track(const Along& along, double from, double to) {
  if (!(from < to)) return;
  double at = from;
  const RadialTrack& track = along.track;
  const auto knots = kernel_.knots();
  const std::size_t count = along.tiny ? offset_.knots() : knots.size();
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t next = track.sense > 0 ? i : count - 1 - i;
    const double cut = along.tiny ? offset_.chord(track, next) : track.chord(knots[next]);
    if (!(cut > at && cut < to)) continue;
    add_pieces(along, at, cut);
    at = cut;
  }
  add_pieces(along, at, to);
}

// Cut at the doubles of the chord where r begins to grow: in the complex plane r is 0 at i times that chord.
void RadialIntegral::add_pieces(const Along& along, double from, double to) {
  const RadialTrack& track = along.track;
  double at = from;
  if (track.sense > 0) {
    double cut = std::max(std::fabs(track.start) / std::sqrt(track.lambda), 0x1p-60 * to);
    for (; cut < to; cut *= 2) {
      if (!(cut > at)) continue;
      add_piece(along, at, cut, 0);
      at = cut;
    }
  }
  add_piece(along, at, to, 0);
}

double RadialIntegral::bound_in_disk(const Along& along, int piece, double r, double reach) const {
  if (along.tiny) return offset_.difference_in_disk(piece, r, reach);
  return kernel_.q_in_disk(piece, r, reach);
}

void RadialIntegral::add_piece(const Along& along, double from, double to, int depth) {
  const RadialTrack& track = along.track;
  const double mid = 0.5 * (from + to), half = 0.5 * (to - from), weight = std::fabs(along.weight);
  const auto knots = kernel_.knots();
  // In which piece of the kernel: r is monotone, its middle is inside. Nothing lies beyond the support.
  // On a tiny circle places are counted from its centre.
  const double r_mid = along.tiny ? offset_.along(track, mid) : track.r(mid);
  const int piece = along.tiny ? offset_.piece_of(r_mid) : std::clamp(kernel_.piece_of(r_mid), 0, kernel_.pieces() - 1);
  const double travel = 2 * half * track.absolute_rise(to);  // the rise grows with the chord
  const double top = along.tiny ? offset_.top() : kernel_.bounds(piece).q;
  if (travel * top <= along.target) {
    error_ += weight * travel * top;
    return;
  }

  int nodes = 0;
  double remainder = HUGE_VAL;
  for (std::size_t i = 0; i < std::size(kEllipses) && nodes != 4; ++i) {
    const double rho = kEllipses[i];
    RadialTrack::Reach reach{};
    if (!track.reach(mid, half * (rho + 1 / rho) / 2, half * (rho - 1 / rho) / 2, reach)) break;
    const double share = bound_in_disk(along, piece, r_mid, reach.reach) * reach.rise * half;
    for (int n = 4; n <= kMostNodes && (nodes == 0 || n < nodes); n += 2) {
      const double missed = gauss_remainder(i, n) * share;
      if (!(missed <= along.target)) continue;
      nodes = n;
      remainder = missed;
    }
  }
  if (nodes == 0) {
    if (depth < kMostHalvings) {
      add_piece(along, from, mid, depth + 1);
      add_piece(along, mid, to, depth + 1);
      return;
    }
    error_ += weight * travel * top;  // nothing is left of it
    return;
  }

  const Rule rule = gauss_legendre(nodes);
  const auto n = rule.node.size();
  double r[kMaxNodes], q[kMaxNodes], rise[kMaxNodes], at_most[kMaxNodes];
  bool near_knot[kMaxNodes];
  for (std::size_t i = 0; i < n; ++i) {
    const double c = mid + half * rule.node[i];
    near_knot[i] = false;
    rise[i] = rule.weight[i] * track.rise(c);
    at_most[i] = rule.weight[i] * track.absolute_rise(c);
    if (along.tiny) {
      q[i] = offset_.difference(offset_.along(track, c));
    } else {
      const double left = knots[static_cast<std::size_t>(piece)], right = knots[static_cast<std::size_t>(piece) + 1];
      r[i] = std::clamp(track.r(c), left, right);
      near_knot[i] = std::min(r[i] - left, right - r[i]) <= 0x1p-48 * right;
    }
  }
  if (!along.tiny) kernel_.q_pieces(piece, {r, n}, q);
  double sum = 0, absolute = 0, turned = 0, turned_near = 0;
  for (std::size_t i = 0; i < n; ++i) {
    sum += rise[i] * q[i];
    absolute += at_most[i] * std::fabs(q[i]);
    turned += at_most[i];
    if (near_knot[i]) turned_near += at_most[i];
  }
  sum_.add(along.weight * half * sum);
  // Weights to 2 u, the rise to 12 u and 4 u for its place, products and half to 6 u, the plain sum to n u.
  double each = along.tiny ? offset_.error() : 0;
  if (!along.tiny) {
    const RadialKernel::PieceBounds& b = kernel_.bounds(piece);
    each = b.q_error + along.off * kUnit * b.growth;
    error_ += weight * half * turned_near * along.off * kUnit * b.jump;
  }
  error_ += weight * half * (turned * each + kUnit * static_cast<double>(nodes + 24) * absolute);
  error_ += weight * remainder;
}

}  // namespace moire
