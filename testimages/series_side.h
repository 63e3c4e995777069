// One side of a polygon in the series of checker_series.h: which part of it is integrated from line to line, which is
// left to the tail towards the horizon or out, and its integral with a bound. The weight is whatever the side's terms
// g_j say it is.
//
// Error bounds are sums of three parts: terms that are dropped where W is small, the stretches towards the horizon, and
// rounding, which is bounded while it happens. The remainder of the series is the polygon's, not the side's.
#pragma once

#include <array>
#include <cstddef>
#include <functional>

#include "testimages/board_side.h"
#include "testimages/euler_polynomials.h"

namespace moire {

// What bounds are aimed at, of J: where only the remainder is in the way, and of all stretches towards the horizon. A
// side is cut into at most `max_pieces` pieces.
struct SeriesAim {
  double remainder, horizon, max_pieces;
  // Where the weight is no polynomial of low degree: between lines only where they are few, however much that loses.
  bool quick = false;
};

// What the rows' values on a polygon may be off by: of the family that is smooth, of the one that jumps, and of W.
struct SeriesNoise {
  double s = 0, j = 0, w = 0;
};

// One bound for each of the g_j.
using TermBounds = std::array<double, kMaxTerms + 1>;

// Bounds on sums over the terms, for |t| <= 1/2 and W up to the polygon's deepest: of them, of their slopes in t, of
// their absolute parts times the roundings in them, and of what the g_j may be off by.
struct SeriesSizes {
  double size = 0, slope = 0, absolute = 0, error = 0;

  // What `count` terms come to at W = ratio times the W in whose powers they are counted; top[j] and error[j] bound g_j
  // and the error of its value, a polynomial of that degree along sides.
  SeriesSizes() = default;
  SeriesSizes(const TermBounds& top, const TermBounds& error, int degree, int count, double ratio);
  // Per unit of |C / det| times the integral of W.
  double rounding() const;
};

// The terms that a polygon's sides are summed over.
struct SeriesTerms {
  TermBounds top, error;  // as above
  double deepest;         // W in whose powers they are counted
  Bounded det;
  int count = 1;
  SeriesSizes sizes{};
  double nearby = 0;  // on the sum of the terms at complex points near the polygon, for quadrature
};

// How far those complex points are from the side, in half lengths of the weight: the scale on which it varies.
inline constexpr double kBeside = 0.25;

// The weight along a side.
struct SideWeight {
  // Of the g_j as polynomials in tau; kNoPolynomial: they are none.
  int degree;
  // How far the side goes in half lengths of the weight.
  double extent;
  // g_0 to g_(count - 1) at tau.
  std::function<void(double tau, int count, double* g)> at;
  // Bound on |g_j| at complex points within `radius` half lengths of the side.
  std::function<double(int j, double radius)> top_nearby;
};
inline constexpr int kNoPolynomial = 1000;

// Bounds on J, estimated well enough to choose by: for what is left out of the side, and for its rounding.
struct SideEstimate {
  double left_out = 0, lost = 0;
};

// Sets side.from and side.left_out, for a weight of that degree and extent along the side.
SideEstimate lay_out(BoardSide& side, int degree, double extent, const SeriesTerms& terms, const SeriesNoise& noise,
                     const SeriesAim& aim);

// What integrate() will leave in doubt besides rounding, about, and between how many lines it will have to integrate;
// and what it would leave in doubt with aim.quick, or if every side were integrated as it was laid out. Known in far
// less time than the integral.
struct SeriesOutlook {
  double doubt = 0, lines = 0, quick = 0, laid_out = 0;

  void add(const SeriesOutlook& other);
};
SeriesOutlook outlook(const BoardSide& side, const SideWeight& weight, const SeriesTerms& terms,
                      const SeriesNoise& noise, const SeriesAim& aim);

// The side's part of J, of that many sides in all.
Bounded integrate(const BoardSide& side, const SideWeight& weight, const SeriesTerms& terms, const SeriesNoise& noise,
                  const SeriesAim& aim, std::size_t sides);

}  // namespace moire
