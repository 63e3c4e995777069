// Areas that disks have in common, as tables: what two points at a distance contribute to the L2 discrepancies of
// disks.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace moire {

// A function of q = (d / 2R)^2 >= 0 for two disks of radius R whose centres are d apart; 0 from q = 1 on. Absolute
// error below 1e-15 for lens (at most pi) and below 5e-16 for mean_lens (at most pi / 3), nearly all of it rounding.
//
// Such a function has a root or a logarithm at both ends of [0, 1] and is smooth between. So the interval is cut into
// pieces of relative width 1/32 .. 1/64 of m, the distance from the nearer end, with a polynomial of degree 6 each,
// through 7 Chebyshev points. Seen from a piece, the singular end is 65 half-widths away or more; for m^(1/2), the
// worst that occurs, Chebyshev's expansion converges like 130^-k and its first dropped term is below 5e-17.
// Nearer to an end than 2^-13 the function is computed as such, which random pairs seldom need.
class DiskOverlap {
 public:
  // f(q, p) at p = 1 - q, both in [0, 1]; the smaller one of them is given without error.
  using Function = double (*)(double q, double p) noexcept;
  explicit DiskOverlap(Function f);

  [[gnu::always_inline]] double operator()(double q) const noexcept {
    const double p = 1 - q;
    const double m = std::min(p, q);
    const auto bits = std::bit_cast<std::int64_t>(m);
    // 0 <= m < kNear, in one comparison: either half alone would be a branch taken at random.
    if (static_cast<std::uint64_t>(bits) < std::bit_cast<std::uint64_t>(kNear)) [[unlikely]]
      return f_(q, p);
    // Beyond q = 1 m is negative, as a number and as an integer: the piece in front, which is 0.
    const std::int64_t piece = std::max<std::int64_t>((bits >> kShift) - kFirst, -1);
    const Piece& c = pieces_[static_cast<std::size_t>(piece + 1 + (p < q ? kPieces : 0))];
    const double t = m - c.centre;
    return (((((c.a[6] * t + c.a[5]) * t + c.a[4]) * t + c.a[3]) * t + c.a[2]) * t + c.a[1]) * t + c.a[0];
  }

  // Lens: the common area of two disks over R^2, 2 (acos c - c s) with c = sqrt q, s = sqrt(1 - q).
  static const DiskOverlap& lens();
  // Mean lens: the integral of the common area over radii from 0 to R, over R^3,
  // (2/3) (acos c - 2 c s + c^3 ln((1 + s) / c)).
  static const DiskOverlap& mean_lens();

 private:
  static constexpr double kNear = 0x1p-13;
  // A piece's number is the exponent and the 5 leading bits of m's fraction.
  static constexpr int kShift = 52 - 5;
  static constexpr std::int64_t kFirst = std::bit_cast<std::int64_t>(kNear) >> kShift;
  // Of each end: one that is 0, then those from kNear on; the last one begins at m = 1/2, which occurs.
  static constexpr std::int64_t kPieces = (std::bit_cast<std::int64_t>(0.5) >> kShift) - kFirst + 2;

  // Powers of m - centre; a cache line.
  struct alignas(64) Piece {
    double centre, a[7];
  };

  Function f_;
  std::vector<Piece> pieces_;  // kPieces for small q, then kPieces for small p
};

}  // namespace moire
