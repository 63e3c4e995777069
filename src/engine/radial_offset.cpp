// Sums over the pieces of a radial kernel between the centre of a tiny circle and its points, with their bound.
#include "engine/radial_offset.h"

#include <algorithm>
#include <cmath>

#include "core/rounding.h"
#include "curve/quadrature.h"

namespace moire {
namespace {

// The integrand k(s) s is a polynomial of degree d + 1: so many nodes are exact.
int nodes_for(const RadialKernel& kernel) { return std::min((kernel.degree() + 3) / 2, kMaxNodes); }

}  // namespace

// What the difference errs by, |offset| <= radius, s <= D + radius = `far`, r >= D - radius = `near`:
//  - k: its error, and its slope times what the place of a node errs by, 4 u of it; q(D): its error, and for the rest
//  of
//    D that it leaves out, |q'| <= 2 max |k| / D, 2 u max |k|;
//  - weights to 2 u, products and the sum of n terms below: (n + 12) u of the absolute terms, which are at most
//    2 max |k| far;
//  - a knot counted from D: 2 u of the radius, there k is off by the jump;
//  - the offset itself: 40 u of the radius.
void RadialOffset::place(Dd distance, double radius) {
  distance_ = distance.hi;
  rest_ = distance.lo;
  radius_ = radius;
  q_ = kernel_.q(distance_);
  at_.clear();
  const auto from_here = [&](double knot) { return (knot - distance_) - rest_; };
  first_ = 0;
  for (const double knot : kernel_.knots()) {
    const double offset = from_here(knot);
    if (offset <= -radius) {
      ++first_;
    } else if (offset < radius) {
      at_.push_back(offset);
    }
  }
  --first_;  // of the knots left of the circle, the first is the centre
  home_ = piece_of(0);
  const double near = distance_ - radius, far = distance_ + radius, k_max = kernel_.k_max();
  top_ = 2 * k_max * radius * far / (near * near) * (1 + 0x1p-20);
  const double knots = static_cast<double>(at_.size());
  const double wrong = kernel_.k_error() + 4 * kUnit * far * kernel_.slope_max() + 2 * kernel_.q_error() +
                       kUnit * k_max * (2 * nodes_for(kernel_) + 30 + 80) + 2 * kUnit * knots * kernel_.jump_max();
  error_ = (radius * far / (near * near) * wrong + 4 * kUnit * top_) * (1 + 0x1p-20);
}

// r^2 - D^2 = radius (radius -+ 2 D) +- (D / radius) c^2, a difference of numbers of the size of radius D.
double RadialOffset::along(const RadialTrack& track, double chord) const {
  const double squares =
      track.sense * (track.lambda * (chord * chord) - radius_ * (2 * distance_ - track.sense * radius_));
  return squares / (std::sqrt(std::max(0.0, distance_ * distance_ + squares)) + distance_);
}

double RadialOffset::chord(const RadialTrack& track, std::size_t knot) const {
  const double squares = at_[knot] * (2 * distance_ + at_[knot]);
  const double part = track.sense * squares + radius_ * (2 * distance_ - track.sense * radius_);
  return std::sqrt(std::max(0.0, part / track.lambda));
}

int RadialOffset::piece_of(double offset) const {
  return first_ + static_cast<int>(std::upper_bound(at_.begin(), at_.end(), offset) - at_.begin());
}

double RadialOffset::difference(double offset) const {
  const double r = distance_ + offset;
  return integral(offset) / (r * r);
}

double RadialOffset::integral(double offset) const {
  int piece = home_;
  double from = 0, sum = 0;
  while (offset > from && piece - first_ < static_cast<int>(at_.size())) {
    const double knot = at_[static_cast<std::size_t>(piece - first_)];
    if (knot >= offset) break;
    sum += over(piece++, from, knot);
    from = knot;
  }
  while (offset < from && piece > first_) {
    const double knot = at_[static_cast<std::size_t>(piece - first_ - 1)];
    if (knot <= offset) break;
    sum += over(piece--, from, knot);
    from = knot;
  }
  return sum + over(piece, from, offset);
}

// Backwards where to < from. k is nothing beyond the radius.
double RadialOffset::over(int piece, double from, double to) const {
  const Rule rule = gauss_legendre(nodes_for(kernel_));
  const double middle = 0.5 * (from + to), half = 0.5 * (to - from);
  const auto knots = kernel_.knots();
  const auto i = static_cast<std::size_t>(piece);
  double sum = 0;
  for (std::size_t j = 0; j < rule.node.size(); ++j) {
    const double s = distance_ + (middle + half * rule.node[j]);
    const double k = piece < kernel_.pieces() ? kernel_.k_piece(piece, std::clamp(s, knots[i], knots[i + 1])) : 0;
    sum += rule.weight[j] * (k - 2 * q_) * s;
  }
  return half * sum;
}

// The integral runs from D along the real axis, and from D + offset on inside the disk.
double RadialOffset::difference_in_disk(int piece, double offset, double reach) const {
  const double r = distance_ + offset, k_max = kernel_.k_max();
  if (!(reach < r)) return HUGE_VAL;
  const double there = piece < kernel_.pieces() ? kernel_.k_in_disk(piece, reach) : 0;
  const double along = std::fabs(offset) * 2 * k_max * (distance_ + radius_) + reach * (there + k_max) * (r + reach);
  return along / ((r - reach) * (r - reach)) * (1 + 0x1p-20);
}

}  // namespace moire
