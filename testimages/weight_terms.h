// What repeated integration by parts in a checkerboard makes of a weight: the g_j of the series in checker_series.h,
// for a weight that is a product of polynomials g = p(x) q(y) on a rectangle.
//
// g_(j+1) = (3 + j) e g_j - Y g_j with Y = Yx + Yy, Yx = (A - e x) d/dx, Yy = (B - e y) d/dy. The two parts commute,
// and with -Y = e theta the product over j is a rising factorial of theta_x + theta_y + 3, which Vandermonde's
// convolution (Digital Library of Mathematical Functions, 5.15) takes apart:
//
//   g_j(x, y) = sum over k <= j of binomial(j, k) P_k(x) Q_(j-k)(y),   P_0 = p, P_(k+1) = ((1 + k) e - Yx) P_k,
//                                                                     Q_0 = q, Q_(k+1) = ((2 + k) e - Yy) Q_k,
//
// so that all work is in one dimension. Polynomials are Chebyshev series in coordinates from -1 to 1 over the
// rectangle.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "core/geometry.h"
#include "curve/piece_weight.h"
#include "testimages/board_side.h"
#include "testimages/euler_polynomials.h"

namespace moire {

// P_k or Q_k for k <= kMaxTerms in one coordinate.
class WeightChain {
 public:
  // `a` and `e` as above, in units of the piece's half length; `first` is 1 for P and 2 for Q.
  WeightChain(const PieceWeight& piece, Bounded a, Bounded e, int first);

  int degree() const { return static_cast<int>(size_) - 1; }
  std::span<const double> series(std::size_t k) const { return {&c_[k * size_], size_}; }
  double at(std::size_t k, double t) const;
  // The first `count` of them.
  void at(double t, std::size_t count, double* out) const;
  // Bounds on |P_k| and on its slope in t; on the error of at() where t comes from t_of() and a
  // mean of two such.
  double top(std::size_t k) const { return top_[k]; }
  double error(std::size_t k) const { return error_[k]; }
  // On |P_k| in all disks of that radius around points of [-1, 1].
  double top_nearby(std::size_t k, double radius) const;
  // From pixels.
  double t_of(double x) const { return (x - mid_) * inverse_half_; }
  double inverse_half() const { return inverse_half_; }

 private:
  std::size_t size_;
  double mid_, inverse_half_;
  std::vector<double> c_;         // of polynomial k at k size
  std::vector<double> by_power_;  // the same, coefficient i of all polynomials at i (kMaxTerms + 1)
  std::array<double, kMaxTerms + 1> top_{}, error_{};
};

// The g_j in units of W^-j, W = `deepest`.
class WeightTerms {
 public:
  // (A, B) is G1 - e p at the rectangle's centre p, per pixel; both and e times `deepest`.
  WeightTerms(const PieceWeight& x, const PieceWeight& y, Bounded a, Bounded b, Bounded e);

  // Largest degree along a side.
  int degree() const { return x_.degree() + y_.degree(); }
  // Bound on |g_j|, and on the error of its value on a side.
  double top(int j) const { return top_[static_cast<std::size_t>(j)]; }
  double error(int j) const { return error_[static_cast<std::size_t>(j)]; }
  const std::array<double, kMaxTerms + 1>& tops() const { return top_; }
  const std::array<double, kMaxTerms + 1>& errors() const { return error_; }
  // Bound on |g_j| at complex points within that radius, in half lengths, of the rectangle.
  double top_nearby(int j, double radius) const;

  // Of the g_j as polynomials in tau along a side; and how far that goes in half lengths of the rectangle, the longer
  // of the two coordinates.
  struct Extent {
    int degree;
    double extent;
  };
  Extent extent(Vec2 a, Vec2 b) const;

  // Along a side.
  class Along {
   public:
    Along(const WeightTerms& terms, Vec2 a, Vec2 b, int count);
    // See Extent.
    int degree() const { return degree_; }
    double extent() const { return extent_; }
    // g_0 to g_(count - 1) at tau; count up to that of the constructor.
    void at(double tau, int count, double* g) const;

   private:
    const WeightTerms* terms_;
    int degree_;
    double x_, dx_, y_, dy_, extent_;
    // On sides of constant x or y, in the other coordinate: coefficient i of all terms at i count.
    std::vector<double> series_;
  };

 private:
  WeightChain x_, y_;
  std::array<double, kMaxTerms + 1> top_{}, error_{};
};

}  // namespace moire
