// A radial reconstruction kernel k(r): piecewise Chebyshev series for k and for what its integrals over plane sets
// need.
//
// G(r) is the integral of k(s) s ds from 0 to r, q(r) = G(r) / r^2: the field q(r) (x, y) has the divergence k(r), so
// that by Green's theorem the integral of k over a plane set is that of q(r) (x dy - y dx) around it. k is normalised
// by its own pieces to 2 pi G(radius) = 1. Distances r >= 0 in pixels from the kernel's centre. Half-open: k(r) = 0 for
// r >= radius. q and G have no jumps, and r q' = k - 2 q.
#pragma once

#include <numbers>
#include <span>
#include <vector>

#include "filters/kernel_pieces.h"
#include "filters/shape_fit.h"

namespace moire {

class RadialKernel {
 public:
  // G from the radius on.
  static constexpr double kWhole = 0.5 * std::numbers::inv_pi;

  // What holds on one piece.
  struct PieceBounds {
    double k = 0, slope = 0, q = 0;  // largest |k|, |k'| per pixel, |q|
    double growth = 0;               // largest |r q'| = |k - 2 q|: what an error of r, as a share of it, does to q
    double jump = 0;                 // the larger of the jumps of k at the piece's two ends
    // Errors of k_piece() and q_piece() at the same r: fit, rounded coefficients, evaluation.
    double k_error = 0, q_error = 0;
  };

  // shape.knots run from 0 to the radius, none but the first two more than doubling; shape.shape(piece, r).
  explicit RadialKernel(const KernelShape& shape);

  double radius() const noexcept { return knots_.back(); }
  std::span<const double> knots() const noexcept { return knots_; }
  int pieces() const noexcept { return static_cast<int>(pieces_.size()); }
  // k is a polynomial of this degree between knots, q on the first piece, too; on others G is one, two degrees higher.
  int degree() const noexcept { return degree_; }

  double k(double r) const noexcept;
  double q(double r) const noexcept;  // also beyond the radius: kWhole / r^2
  double G(double r) const noexcept;
  // out[i] = k(sqrt(x[i] x[i] + y[i] y[i])), bit for bit.
  void weights(std::span<const double> x, std::span<const double> y, std::span<double> out) const noexcept;

  // The piece that r lies in, pieces() beyond the support.
  int piece_of(double r) const noexcept { return moire::piece_of(knots_, r); }
  // One piece's k and q, for knots[piece] <= r <= knots[piece + 1].
  double k_piece(int piece, double r) const noexcept;
  double q_piece(int piece, double r) const noexcept;
  // out[i] = q_piece(piece, r[i]): for many points quicker than one by one.
  void q_pieces(int piece, std::span<const double> r, double* out) const noexcept;
  // Bounds on the absolute values of the analytic continuations of k and q from one piece to the disks of radius
  // `reach` in the complex plane around its points, of q around the point r alone; infinite where q may have its pole
  // there.
  double k_in_disk(int piece, double reach) const noexcept;
  double q_in_disk(int piece, double r, double reach) const noexcept;
  // One piece's Chebyshev series of k.
  std::span<const double> k_series(int piece) const noexcept {
    return {k_coefficients(piece), static_cast<std::size_t>(degree_) + 1};
  }
  const PieceBounds& bounds(int piece) const noexcept { return bounds_[static_cast<std::size_t>(piece)]; }

  // Integral over the plane of the shape before normalisation.
  double integral() const noexcept { return integral_; }
  // Bounds over the whole support: |k| (and so 2 |q|), |k'| inside pieces, and the largest jump of k at a knot, the
  // radius included.
  double k_max() const noexcept { return k_max_; }
  double slope_max() const noexcept { return slope_max_; }
  double jump_max() const noexcept { return jump_max_; }
  // Bounds on the errors of k(), q() and G() at the same r, the rounding of the evaluation included. "True" is the
  // plug-in's closed form divided by its own integral.
  double k_error() const noexcept { return k_error_; }
  double q_error() const noexcept { return q_error_; }
  double G_error() const noexcept { return G_error_; }

 private:
  const SeriesPiece& piece(int i) const noexcept { return pieces_[static_cast<std::size_t>(i)]; }
  // Of the series that q comes from: q itself on the first piece, G on the others.
  int integral_degree(int i) const noexcept { return i == 0 ? degree_ : degree_ + 2; }
  const double* k_coefficients(int i) const noexcept { return coefficients_.data() + piece(i).k_first; }
  const double* integral_series(int i) const noexcept { return coefficients_.data() + piece(i).integral_first; }
  void set_bounds(const ShapeFit& fit, double fit_error, std::span<const double> lost_k, std::span<const double> lost);

  std::vector<double> knots_;
  std::vector<SeriesPiece> pieces_;
  std::vector<PieceBounds> bounds_;
  std::vector<double> coefficients_;
  int degree_ = 0;
  double integral_ = 0, k_max_ = 0, slope_max_ = 0, jump_max_ = 0, k_error_ = 0, q_error_ = 0, G_error_ = 0;
};

}  // namespace moire
