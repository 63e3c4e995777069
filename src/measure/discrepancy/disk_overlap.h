// Areas that disks have in common, as tables: what two points at a distance contribute to the L2 discrepancies of
// disks.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/double_double.h"

namespace moire {

// A function of q = (d / 2R)^2 >= 0 for two disks of radius R whose centres are d apart; 0 from q = 1 on. Absolute
// error below 1e-15 for lens (at most pi) and below 5e-16 for mean_lens (at most pi / 3), nearly all of it rounding.
//
// Such a function has a root or a logarithm at both ends of [0, 1] and is smooth between. So the interval is cut into
// pieces of relative width 1/16 .. 1/32 of m, the distance from the nearer end, with a polynomial of degree 7 each,
// through 8 Chebyshev points. Seen from a piece, the singular end is 33 half-widths away or more; for m^(1/2), the
// worst that occurs, Chebyshev's expansion converges like 66^-k and its first dropped term is below 1e-16 of the value.
// From 2^-110 on to the end the function has the value at the end, of which it is within 2^-52: 4 m^(1/2) for lens.
class DiskOverlap {
 public:
  // f(q, p) at p = 1 - q, both in [0, 1]; the smaller one of them is given without error.
  using Function = Dd (*)(double q, double p) noexcept;
  explicit DiskOverlap(Function f);

  [[gnu::always_inline]] double operator()(double q) const noexcept {
    const double p = 1 - q;
    // Beyond q = 1 p is negative.
    const double m = std::max(std::min(p, q), kEnd);
    const auto bits = std::bit_cast<std::int64_t>(m);
    const std::int64_t piece = 2 * ((bits >> kShift) - kFirst) + (p < q ? 1 : 0);
    const double* const a = pieces_[static_cast<std::size_t>(piece)].a;
    const double t = m - std::bit_cast<double>((bits & kPieceBits) | kHalfPiece), t2 = t * t;
    // By pairs of terms, after G. Estrin (1960), so that less of it has to wait.
    return (((a[6] + a[7] * t) * t2 + (a[4] + a[5] * t)) * t2 + (a[2] + a[3] * t)) * t2 + (a[0] + a[1] * t);
  }

  // Lens: the common area of two disks over R^2, 2 (acos c - c s) with c = sqrt q, s = sqrt(1 - q).
  static const DiskOverlap& lens();
  // Mean lens: the integral of the common area over radii from 0 to R, over R^3,
  // (2/3) (acos c - 2 c s + c^3 ln((1 + s) / c)).
  static const DiskOverlap& mean_lens();

  // The table itself, for code that looks up many at once, as operator() does.
  //
  // A piece's number is the exponent and the 4 leading bits of m's fraction; with the next bit set, and no other, that
  // is its centre. The first piece is constant, for m <= kEnd; the last one begins at m = 1/2, which occurs.
  static constexpr int kShift = 52 - 4;
  static constexpr std::int64_t kPieceBits = -(std::int64_t{1} << kShift);
  static constexpr std::int64_t kHalfPiece = std::int64_t{1} << (kShift - 1);
  static constexpr double kEnd = 0x1p-110;
  static constexpr std::int64_t kFirst = std::bit_cast<std::int64_t>(kEnd) >> kShift;
  static constexpr std::int64_t kPieces = (std::bit_cast<std::int64_t>(0.5) >> kShift) - kFirst + 1;

  // Powers of m - centre; a cache line. Of 223 KB random pairs want 10 KB nearly always.
  struct alignas(64) Piece {
    double a[8];
  };
  // Piece 0 for small q, piece 0 for small p, piece 1 ...
  const Piece* pieces() const noexcept { return pieces_.data(); }

 private:
  std::vector<Piece> pieces_;
};

}  // namespace moire
