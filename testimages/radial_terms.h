// What repeated integration by parts in a checkerboard makes of a radial weight: the g_j of the series in
// checker_series.h for g = k(r), r = |p|, on one piece of k.
//
// j integrations by parts along u at constant v leave a j-th derivative with u. Along such a line W = W0 omega, omega =
// 1 / (1 + e W0 s) for u = u0 + s, and p = p0 + a sigma with a = G - e p0 and sigma = W0 s omega: p runs straight, r is
// the root of r0^2 + 2 (p0 . a) sigma + a^2 sigma^2, and with k(r(sigma)) = sum of kappa_i sigma^i the j-th derivative
// of g omega^3 is a sum over i of kappa_i times that of omega^(i+3) s^i:
//
//   g_j = (-1)^j j! sum over i <= j of binomial(j + 2, j - i) (-e)^(j-i) kappa_i.
//
// kappa comes from the Taylor series of k at r0 and of the root, by arithmetic of truncated power series. Bounds are
// the same arithmetic on series whose coefficients are at least as large ("majorants"): a root's are those of 1 -
// sqrt(1 - q), q >= 0.
#pragma once

#include "core/geometry.h"
#include "curve/piece_weight.h"
#include "testimages/board_frame.h"
#include "testimages/euler_polynomials.h"
#include "testimages/radial_taylor.h"
#include "testimages/series_side.h"

namespace moire {

// The g_j in units of W^-j, W = `deepest`, for one piece of k as a polynomial: also a little beyond its ends. Points
// relative to the weight's centre, like the rows.
class RadialTerms {
 public:
  RadialTerms(const BoardFrame& frame, const PieceWeight& piece, double deepest);

  // g_0 to g_(count - 1) at a point, p != 0.
  void at(Vec2 p, int count, double* g) const;
  // Bounds for low <= |p| <= high, 0 < low, inside the piece but for rounding: on |g_j|; on the error of at(); and on
  // |g_j| at complex points within `reach` <= low / 4 of such points along some real direction.
  TermBounds top(double low, double high) const;
  // The same from bounds on the Taylor coefficients of k along lines (radial_rings.h).
  TermBounds top(const TermBounds& along, double high) const;
  TermBounds error(double low, double high) const;
  TermBounds nearby(double low, double high, double reach) const;
  // On |g_j| of the difference of two pieces, for |p| between the knot between them and `within` less; no outer piece:
  // of the inner one.
  static TermBounds jump(const RadialTerms& inner, const RadialTerms* outer, double knot, double within);
  // Bound on |G - e p| within that distance, times `deepest`.
  double drift(double r) const;
  // The length on which k and r vary: a quarter of r, or of the piece.
  double scale(double r) const;
  double half() const { return k_.half(); }  // of the piece's length

 private:
  TermBounds majorant(const double* k, const double* distance) const;

  double gx_, gy_, e_, drift_error_, e_error_;
  RadialTaylor k_;
};

}  // namespace moire
