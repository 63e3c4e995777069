// A reconstruction kernel in one dimension: piecewise Chebyshev series for k and its antiderivative K.
//
// One code path for all kernels: a polynomial kernel is its own series, a smooth one (Gaussian) is fitted to rounding.
// Everything is normalised by the integral of the same pieces, so K runs from exactly 0 to exactly 1. Distances in
// pixels from the kernel's centre. Half-open: k(x) = 0 for x < -radius and for x >= radius.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "filters/kernel_pieces.h"
#include "filters/shape_fit.h"

namespace moire {

class Kernel {
 public:
  // What holds on one piece, t = (x - middle) / half length running from -1 to 1 over it.
  struct PieceBounds {
    // Largest |k|, |K| and |k'| per pixel, also up to kBeyond of the radius beyond the piece's ends.
    double k = 0, K = 0, slope = 0;
    double jump = 0;  // the larger of the jumps of k at the piece's two ends
    // Errors of k_at() and K_at() at the same t, and of k_piece() and K_piece() at the same x: fit, rounded
    // coefficients, evaluation. The second are larger by what t_of() errs.
    double k_error = 0, K_error = 0, k_error_at_x = 0, K_error_at_x = 0;
    double t_error = 0;  // of t_of()
  };

  // Pieces of a circle may stick out of their cell by 16 times 24 u of the radius (engine/boundary_arcs.cpp), below
  // 2^-44 of it, and 2^-94 of the circle's own radius, which is below 2^50 of the kernel's. On the shortest pieces that
  // is 2^-12 of their half length.
  static constexpr double kBeyond = 0x1p-43;

  explicit Kernel(const KernelShape& shape);

  double radius() const noexcept { return knots_.back(); }
  // k is a polynomial of degree() between knots; the first knot is -radius, the last +radius.
  std::span<const double> knots() const noexcept { return knots_; }
  int pieces() const noexcept { return static_cast<int>(knots_.size()) - 1; }
  int degree() const noexcept { return degree_; }

  double k(double x) const noexcept;
  double K(double x) const noexcept;  // integral of k from -radius to x
  // out[i] = k(x[i]).
  void weights(std::span<const double> x, std::span<double> out) const noexcept {
    weights_of({knots_, pieces_, coefficients_.data(), degree_}, x, out);
  }
  // k = 1 on [-1/2, 1/2): every weight is exactly 1, so that weight sums are counts.
  bool is_unit_box() const noexcept { return unit_box_; }

  // The piece that x lies in, -1 left of the support, pieces() right of it.
  int piece_of(double x) const noexcept { return moire::piece_of(knots_, x); }
  // Whether x is within `distance` of an end of the piece; -1 <= piece <= pieces().
  bool near_knot(int piece, double x, double distance) const noexcept;
  // The polynomials of one piece, also usable a little beyond its ends.
  double k_piece(int piece, double x) const noexcept;
  double K_piece(int piece, double x) const noexcept;
  // Bounds on their absolute values over the Bernstein ellipse of parameter rho around the piece.
  double k_on_ellipse(int piece, double rho) const noexcept;
  double K_on_ellipse(int piece, double rho) const noexcept;
  // The Chebyshev coefficients of k on the piece: k_at() to rounding.
  std::span<const double> k_series(int piece) const noexcept {
    return {coefficients_.data() + pieces_[static_cast<std::size_t>(piece)].k_first,
            static_cast<std::size_t>(degree_) + 1};
  }
  double half_length(int piece) const noexcept { return pieces_[static_cast<std::size_t>(piece)].half; }
  // Where x lies in the piece: from -1 to 1.
  double t_of(int piece, double x) const noexcept {
    const SeriesPiece& p = pieces_[static_cast<std::size_t>(piece)];
    return (x - p.mid) * p.inverse_half;
  }
  // out[i] = k or K on the piece at t[i]; for many points this is several times quicker than one by one.
  void k_at(int piece, std::span<const double> t, double* out) const noexcept;
  void K_at(int piece, std::span<const double> t, double* out) const noexcept;
  // -1 <= piece <= pieces(): left and right of the support k = 0 and K = 0 or 1, without error.
  const PieceBounds& bounds(int piece) const noexcept { return bounds_[static_cast<std::size_t>(piece + 1)]; }

  // Integral of the shape before normalisation.
  double integral() const noexcept { return integral_; }
  // Bounds over the whole support: |k|, |K|, and the slope |k'| inside pieces.
  double k_max() const noexcept { return k_max_; }
  double K_max() const noexcept { return K_max_; }
  double slope_max() const noexcept { return slope_max_; }
  // The largest jump of k at a knot, the ends of the support included.
  double jump_max() const noexcept { return jump_max_; }
  // Bounds on |k() - true k| and |K() - true K| at the same x, the rounding of the evaluation included. "True" is the
  // plug-in's closed form divided by its own integral.
  double k_error() const noexcept { return k_error_; }
  double K_error() const noexcept { return K_error_; }

 private:
  std::vector<double> knots_;
  std::vector<SeriesPiece> pieces_;
  std::vector<PieceBounds> bounds_;  // of piece p at p + 1
  std::vector<double> coefficients_;
  int degree_ = 0;
  bool unit_box_ = false;
  double integral_ = 0, k_max_ = 0, K_max_ = 0, slope_max_ = 0, jump_max_ = 0, k_error_ = 0, K_error_ = 0;
};

}  // namespace moire
