// The side of a polygon in a checkerboard's image, and the board's lines that cross it.
//
// Values at the ends of a side come from double-double and are right to a few u = 2^-53 of themselves, however large
// u and v are there.
#pragma once

#include <algorithm>

#include "core/double_double.h"
#include "core/geometry.h"
#include "testimages/homography.h"

namespace moire {

// A value right to `error`, both absolute.
struct Bounded {
  double value = 0, error = 0;
};

// A row's value at a point, right to row_noise() at points whose coordinates are up to `reach`.
inline Dd row_at(const LocalHomography::Row& r, Vec2 p) { return two_prod(r.a, p.x) + two_prod(r.b, p.y) + r.c; }
double row_noise(const LocalHomography::Row& r, double reach);

// From the end with smaller W to the other; sign is -1 where that is against the polygon's order. s and j are the rows
// of the family that integration by parts makes smooth, and of the one that jumps.
struct BoardSide {
  Vec2 a, b;
  Dd s0, s1, j0, j1, w0, w1;
  double sign = 1;
  Bounded along_s, along_j;  // S'W - SW' and J'W - JW', constant on the side; ' = d/dtau, tau from 0 at a to 1 at b
  double from = 0;           // tau from which the side is integrated between lines
  double left_out = 0;       // integral of W over what is not

  // `noise`: of the rows' values.
  BoardSide(const LocalHomography::Row& smooth, const LocalHomography::Row& jump, const LocalHomography::Row& w, Vec2 p,
            Vec2 q, double s_noise, double j_noise, double w_noise);
  // Lines of both families from W = `depth` down to the side's deep end, depth > 0.
  double lines_beyond(double depth) const;
};

// The lines of one family that cross a side beyond tau = from, in order of tau.
//
// On the line number k, F - k W = L0 (1 - tau) + L1 tau = 0. L0 is counted from the square at the start and L1 from
// that at the end, so that both are sums of terms of one sign, up to one square: |error of L0| <= 3u (|L0| + |W0|) +
// noise.
class SideLines {
 public:
  SideLines(Dd f0, Dd f1, const BoardSide& side, double f_noise, double w_noise);

  // False where single squares can not be told apart: beyond 2^40 of them.
  bool valid() const { return valid_; }
  // Tau of the next line; above 1: there is none.
  double next() const { return next_; }
  void advance() {
    current_ += step_;
    --left_;
    at_ = std::min(next_, 1.0);
    find();
  }
  bool odd() const { return current_ != 2 * std::floor(current_ / 2); }
  // F - (k + 1/2) W at the ends, k the current square's number.
  double middle0() const { return base0_ + (first_ - current_ - 0.5) * w0_; }
  double middle1() const { return base1_ + (last_ - current_ - 0.5) * w1_; }
  // Of the values at the ends, beyond their own rounding.
  double noise() const { return noise_; }
  // Sums over the lines passed, d being the error of their tau: of W d, and of |F - k W| where they truly are times d.
  double jump_error() const { return jump_error_; }
  double kink_error() const { return kink_error_; }

 private:
  void find();

  double w0_, w1_, first_ = 0, last_ = 0, current_ = 0, step_ = 1, left_ = 0, base0_ = 0, base1_ = 0, noise_ = 0;
  double at_ = 0, next_ = 2, jump_error_ = 0, kink_error_ = 0;
  bool valid_ = false;
};

}  // namespace moire
