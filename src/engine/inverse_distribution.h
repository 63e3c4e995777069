// Points with a density proportional to |k|, k a filter's kernel: the distribution of |k| inverted, on the kernel's own
// Chebyshev series and without a table. Importance sampling of reconstruction filters as M. Pharr, W. Jakob and
// G. Humphreys, "Physically based rendering", 4th edition 2023, section 8.8 have it, but exact.
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "filters/filter.h"

namespace moire {

// A view of a filter, which must outlive it. Of a separable one, P(x) is the integral of |k| from -radius to x; of a
// radial one that of 2 pi s |k(s)| from 0 to x, the integral over a disk. A = P(radius).
class InverseDistribution {
 public:
  explicit InverseDistribution(const Filter& filter);

  // Pixels from the kernel's centre, and the sign of k around there.
  struct Point {
    double x = 0;
    int sign = 1;
  };

  // For 0 <= u < 1 the x with P(x) = u A: inside the support, below the radius, nowhere falling with u, a function of u
  // alone, and |P(x) - u A| <= error(). Takes about ten evaluations of K and k.
  Point at(double u) const noexcept;
  // The sign of at(u), which is found much faster.
  int sign(double u) const noexcept;

  // A; exactly 1 for a kernel without negative lobes.
  double absolute_integral() const noexcept { return total_; }
  bool has_negative_lobes() const noexcept { return has_negative_lobes_; }
  double error() const noexcept { return error_; }

 private:
  // A part of one piece of the kernel where k has one sign. What at() solves there is gain(x) = w for x.
  struct Stretch {
    int piece = 0, sign = 1;
    double begin = 0, end = 0;
    double before = 0;  // the integral of k up to begin
    double noise = 0;   // if gain(a) + noise <= w then gain(x) <= w for all x < a, as it is computed, and vice versa
  };
  // Bounds of one piece.
  struct Bounds {
    double integral, integral_error;  // the integral of k
    double density, density_error;    // k times what P integrates it with
    double slope;                     // of that product
    double length;
  };

  void add_piece(int piece, const Bounds& bounds, double& worst);
  Bounds bounds_of(int piece) const;
  double integral(int piece, double x) const noexcept;
  double density(int piece, double x) const noexcept;
  // The integral of |k| from the stretch's begin to x.
  double gain(const Stretch& s, double x) const noexcept { return s.sign * (integral(s.piece, x) - s.before); }
  std::size_t stretch_of(double mass) const noexcept;
  // A point near the solution, and the slope of the gain there.
  struct Near {
    double x, slope;
  };
  Near newton(const Stretch& s, double w) const noexcept;
  double solve(const Stretch& s, double w) const noexcept;
  // Multiples of the step by whole numbers >= 0: the last one up to x, and where one is.
  std::uint64_t number_of(double x) const noexcept {
    return static_cast<std::uint64_t>(static_cast<std::int64_t>(std::floor(x / step_)) + kZero);
  }
  double place_of(std::uint64_t number) const noexcept {
    return static_cast<double>(static_cast<std::int64_t>(number) - kZero) * step_;
  }

  static constexpr std::int64_t kZero = std::int64_t{1} << 54;

  const Kernel* kernel_ = nullptr;  // one of the two is null
  const RadialKernel* radial_ = nullptr;
  std::vector<Stretch> stretches_;  // left to right; k is 0 between them
  std::vector<double> mass_;        // of |k| before each stretch
  double total_ = 0, error_ = 0;
  double step_;  // points are multiples of this power of 2, of which the radius has 2^52 to 2^53
  bool has_negative_lobes_ = false;
};

}  // namespace moire
