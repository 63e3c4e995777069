// Radial kernels along chords: integrals of k(sqrt(x^2 + y^2)) times a square wave of x, at one y.
//
// A kernel is taken from its published formula (rings.h) and is one of two kinds: a polynomial of degree 3 in r between
// its breaks, or one function of r^2, analytic over the whole support, as of Gaussians, windowed sincs and jincs.
#pragma once

#include <array>
#include <string_view>
#include <vector>

#include "oracle/quad.h"
#include "oracle/rings.h"

namespace moire::oracle {

// The wave s(u) = (-1)^floor(u) with u = phase + rate x; rate > 0, in squares per pixel.
struct ChordWave {
  long double phase, rate;
  long double at(long double x) const { return phase + rate * x; }
};

class ChordKernel {
 public:
  // Throws std::invalid_argument for kernels of another kind.
  explicit ChordKernel(std::string_view text);

  const RingKernel& rings() const { return rings_; }
  long double radius() const { return circles_.back().radius; }
  // Radii where k or a derivative jumps, increasing; the support's is the last.
  std::vector<long double> circles() const;
  // Whether k has odd powers of r at the centre, so that integrals along chords are not smooth in y at y = 0.
  bool has_cusp() const { return cubic_ && (pieces_[0][1] != 0 || pieces_[0][3] != 0); }

  // Integral of k s over the chord, -radius < y < radius, wave by wave from an antiderivative of k along the chord.
  long double wave_by_wave(long double y, const ChordWave& wave) const;
  // The same where waves are short, by Boole's summation formula (NIST DLMF 24.17.1) with k's derivatives at both ends
  // of every circle's chord, and the branch points x = +-iy of a cusp by the Fourier transform of r and r^3, which are
  // Bessel functions (DLMF 10.32.11). For wave.rate >= least_rate(), to about 1e-14 times
  // k(0).
  long double by_ends(long double y, const ChordWave& wave) const;
  long double least_rate() const { return least_rate_; }

 private:
  static constexpr std::size_t kOrders = 14;  // of Boole's formula
  // Powers of r^2 - radius^2 that enter it.
  using Taylor = std::array<long double, kOrders>;

  struct Circle {
    long double radius;
    // Of order j and power i: the j-th derivative along x at half the chord h is the sum of jump[j][i] h^i; k inside
    // minus k outside.
    std::array<std::array<long double, kOrders>, kOrders> jump{};
  };

  void fit_even();
  void add_circle(long double radius, const Taylor& inside, const Taylor& outside);
  Taylor even_taylor() const;
  void choose_rates();
  long double even_at(long double square) const;
  // Odd antiderivative of k in x at this y: coefficients of T_1, T_3, ... of x over half the chord.
  void integrate_even(long double y, long double half, std::vector<long double>& odd) const;
  long double cubic_integral(long double y, long double x, std::size_t piece) const;
  long double cusp(long double y, const ChordWave& wave) const;

  RingKernel rings_;
  bool cubic_ = false;
  std::vector<std::array<long double, 4>> pieces_;  // powers of r, between breaks
  std::vector<long double> even_;                   // Chebyshev coefficients in r^2 over [0, radius^2]
  std::vector<long double> cosines_;                // cos(2 k theta_j), theta_j the nodes of integrate_even()
  std::vector<Circle> circles_;
  long double least_rate_ = 0;
  std::array<long double, kOrders + 1> rate_for_{};  // from this rate on, orders from j on are below rounding
};

}  // namespace moire::oracle
