// Values under radial kernels without Green's theorem: the scene's share of every ring around the pixel's centre, times
// the kernel, summed over the rings. Kernels from their published formulas, in long double.
#pragma once

#include <functional>
#include <string_view>
#include <vector>

#include "oracle/quadrature.h"
#include "oracle/scene.h"

namespace moire::oracle {

// A radial kernel, normalised to integral 1 over the plane by quadrature of itself. r in pixels.
class RingKernel {
 public:
  // "name" or "name:key=value,..." with the names and defaults of the program. Throws std::invalid_argument.
  explicit RingKernel(std::string_view text);

  long double radius() const { return breaks_.back(); }
  // Where k is not analytic in r; 0 first, the radius last.
  const std::vector<long double>& breaks() const { return breaks_; }
  // k for 0 <= r <= radius; at a break, the value of the outer piece.
  long double operator()(long double r) const { return shape_(r) * scale_; }
  // Integral of k(s) s ds from 0 to r <= radius.
  long double moment(long double r) const;
  // Integral of |k| over the plane, to judge rounding.
  long double gain() const { return gain_; }

 private:
  std::vector<long double> breaks_;
  std::function<long double(long double)> shape_;
  long double scale_ = 1, gain_ = 1;
};

// Integral of scene times k(r) around the pixel's centre.
Value filtered(const RingKernel& k, const Edge& edge, Pixel pixel);
Value filtered(const RingKernel& k, const Disk& disk, Pixel pixel);
Value filtered(const RingKernel& k, const Board& board, Pixel pixel);
// Of a disk, over the square of its radius, by rays from its centre, which is not the pixel's: a tiny disk's value to
// as many digits as a large one's.
Value filtered_per_square(const RingKernel& k, const Disk& disk, Pixel pixel);

}  // namespace moire::oracle
