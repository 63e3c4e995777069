// Sums over the pieces of a kernel, from the centre of a tiny circle outwards, with the bound on their error.
#include "engine/centred_integral.h"

#include <algorithm>
#include <cmath>

#include "core/rounding.h"
#include "core/sum.h"
#include "curve/quadrature.h"

namespace moire {
namespace {

// The integrand is a polynomial of degree d: so many nodes are exact.
int nodes_for(const Kernel& kernel) { return std::min(kernel.degree() / 2 + 1, kMaxNodes); }

}  // namespace

int CentredKnots::piece_of(double offset) const {
  const auto knots = kernel.knots();
  const auto beyond =
      std::partition_point(knots.begin(), knots.end(), [&](double knot) { return from_centre(knot) <= offset; });
  return static_cast<int>(beyond - knots.begin()) - 1;
}

bool CentredKnots::near_knot(int piece, double offset, double distance) const {
  const auto near = [&](int i) {
    return i >= 0 && i <= kernel.pieces() &&
           std::fabs(from_centre(kernel.knots()[static_cast<std::size_t>(i)]) - offset) <= distance;
  };
  return near(piece) || near(piece + 1);
}

void CentredIntegral::place(double centre, double rest, double reach) {
  knots_.centre = centre;
  knots_.rest = rest;
  home_ = knots_.piece_of(0);
  at_.clear();
  before_.clear();
  top_ = error_ = 0;
  walk(-1, reach);
  first_ = home_ - static_cast<int>(at_.size());
  std::reverse(at_.begin(), at_.end());
  std::reverse(before_.begin(), before_.end());
  walk(1, reach);
}

// Piece by piece away from the centre. What the integral from 0 to any point on that side errs by, at most the sum of
//  - k: its error, and its slope times what the place of a node errs by: the knots 2 u R, the node 3 roundings of R and
//    2 u of itself, and in pixel coordinates 2 u of those (the sum's rounding, and `rest`, which is left out);
//  - weights to 2 u, products and the sum of n terms: (n + 8) u of the absolute terms; what is added up before to 2 u;
//  - a knot misplaced by 2 u R: there k is off by the jump and, as a polynomial used beyond its end, by both slopes;
//  - 8 u R of the point itself: k times that.
void CentredIntegral::walk(int step, double reach) {
  const Kernel& kernel = knots_.kernel;
  const double place = kUnit * (2 * std::fabs(knots_.centre) + 12 * reach), knot_error = 2 * kUnit * reach;
  const double roundings = kUnit * (nodes_for(kernel) + 12);
  Sum sum;
  double from = 0, top = 0, error = 0, k_max = 0;
  // Beyond the support there is nothing to add.
  for (int p = home_; step > 0 ? p < kernel.pieces() : p >= 0; p += step) {
    const double knot = knots_.from_centre(kernel.knots()[static_cast<std::size_t>(step > 0 ? p + 1 : p)]);
    const bool whole = std::fabs(knot) < reach;
    const double to = whole ? knot : step * reach, extent = std::fabs(to - from);
    const Kernel::PieceBounds& b = kernel.bounds(p);
    top += extent * b.k;
    error += extent * (b.k_error_at_x + b.slope * place + roundings * b.k);
    k_max = std::max(k_max, b.k);
    if (!whole) break;
    error += knot_error * (b.jump + knot_error * (b.slope + kernel.bounds(p + step).slope));
    sum.add(over(p, from, to));
    at_.push_back(to);
    before_.push_back(sum.value());
    from = to;
  }
  top_ = std::max(top_, top * (1 + 0x1p-20));  // the bounds' own rounding
  error_ = std::max(error_, (error + 8 * kUnit * reach * k_max) * (1 + 0x1p-20));
}

double CentredIntegral::operator()(double offset) const {
  const auto beyond = std::upper_bound(at_.begin(), at_.end(), offset) - at_.begin();
  const int piece = first_ + static_cast<int>(beyond);
  if (piece == home_) return over(piece, 0, offset);
  // The last knot on the way from the centre.
  const auto i = static_cast<std::size_t>(piece > home_ ? beyond - 1 : beyond);
  return before_[i] + over(piece, at_[i], offset);
}

// The integral of the piece's polynomial; backwards where to < from. Nothing outside the support.
double CentredIntegral::over(int piece, double from, double to) const {
  const Kernel& kernel = knots_.kernel;
  if (piece < 0 || piece >= kernel.pieces()) return 0;
  const Rule rule = gauss_legendre(nodes_for(kernel));
  const double middle = 0.5 * (from + to), half = 0.5 * (to - from);
  double sum = 0;
  for (std::size_t j = 0; j < rule.node.size(); ++j) {
    sum += half * rule.weight[j] * kernel.k_piece(piece, knots_.centre + (middle + half * rule.node[j]));
  }
  return sum;
}

}  // namespace moire
