// The integral of a weight over an endless checkerboard's even squares inside a polygon, from the polygon's sides
// alone: the way to pixels that hold thousands of squares, or the horizon and no end of them.
//
// The idea is repeated integration by parts, which turns the square wave into Euler polynomials (euler_polynomials.h)
// and an integral over an area into one over its sides.
//
// Notation. Rows U, V, W of the homography as functions of the image point p, u = U/W, v = V/W, det its determinant,
// s(u) = (-1)^floor(u). The density of even squares is (1 + s(u) s(v)) / 2, so that the integral of g is half of that
// over the polygon P and half of J, the integral of g s(u) s(v) over P. Along u at constant v, dp/du = W (G1 - e p) and
// dW/du = -e W^2 with constants G1, the first column of the inverse homography, and e; dx dy = W^3 / |det| du dv. m
// integrations by parts in u give
//
//   J = 1/det sum over sides of C integral_0^1 s(v) sum_(j<m) g_j W^(j+1) E_(j+1)(u) dtau + R,
//   |R| <= sup|E_m| |P| max over P of |g_m| W^m,   g_0 = g,   g_(j+1) = (3 + j) e g_j - ((G1 - e p) . grad) g_j,
//
// where a side is p(tau), 0 <= tau <= 1, in the polygon's order, and C = V'W - VW' is constant on it (' = d/dtau). For
// a box, g = 1, g_j = e^j (j + 2)! / 2; for polynomials see weight_terms.h. Where no line u or v = integer is crossed,
// W^(j+1) E_(j+1)(u) is a polynomial of degree j + 1 in tau, and Gauss-Legendre quadrature is exact. The same holds
// with u and v exchanged. The work grows with the lines that cross the polygon's sides, not with its squares. In
// one-point perspective e = 0, and the series of a polynomial weight ends by itself.
//
// The remainder grows with W: a window is cut along W = reach() and what is in front of it is left to its squares,
// which are few there.
//
// On the horizon, W = 0, infinitely many lines cross the sides that meet it. The polygon's side on the horizon itself
// contributes nothing; the others are integrated between lines down to some W, and from there as one integral over t =
// 1/W to infinity, in which u and v are linear (square_wave_tail.h). Nothing is assumed of cancellation in there: where
// both families of lines cross a side in step there is little.
#pragma once

#include <vector>

#include "curve/piece_weight.h"
#include "curve/polygon.h"
#include "testimages/board_frame.h"
#include "testimages/board_side.h"
#include "testimages/homography.h"
#include "testimages/series_side.h"
#include "testimages/testimage.h"
#include "testimages/weight_terms.h"

namespace moire {

// The series in one of its two forms: by parts along the rows' first argument.
class CheckerSeries {
 public:
  // The weight's rectangle, relative to the pixel's centre like the rows; polygons lie in it, up to rounding. Terms are
  // counted in powers of W / deepest.
  CheckerSeries(const LocalHomography::Row& smooth, const LocalHomography::Row& jump, const LocalHomography::Row& w,
                const PieceWeight& x, const PieceWeight& y, double deepest);

  // The largest W, up to `deepest`, below which remainder and rounding on a part of that polygon should stay within
  // `goal` each; 0 for none.
  double reach(const Polygon& polygon, double area, double goal) const;
  // Lays the polygon's sides out. Convex, in order (closed integral of x dy positive); where W >= 0, up to rounding.
  void lay_out(const Polygon& polygon, double area, const SeriesAim& aim);
  // An estimate of the bound on J, good enough to choose.
  double estimate() const { return estimate_; }
  // What to expect of it in more detail, which takes longer: remainder and horizon.
  SeriesOutlook outlook() const;
  // J and its bound, for the polygon as it stands: remainder, rounding and the horizon.
  Bounded integrate() const;

 private:
  double remainder(int terms, double area, double ratio) const;
  void choose_terms(double area, double ratio, double goal);
  // Calls visit(side, weight) for all sides.
  template <class Visit>
  void for_sides(const Visit& visit) const;

  BoardFrame frame_;
  WeightTerms weight_;
  SeriesTerms terms_;  // as many as the polygon is given, of those of weight_

  SeriesAim aim_{};
  SeriesNoise noise_;
  std::vector<BoardSide> sides_;
  double depth_ = 0;  // largest W of the polygon
  double remainder_ = 0;
  double estimate_ = 0;
};

}  // namespace moire
