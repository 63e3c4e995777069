// Signs of many points; see point_signs.h. ns per point, g++ 12 -O3, plain, AVX2 and AVX-512: line 1.3, 0.55 and 0.29,
// circle 1.9, 0.62 and 0.35, board 13, 3.2 and 2.0.
#include "testimages/point_signs.h"

#include <cmath>

#include "core/instruction_sets.h"
#include "testimages/board_squares.h"

namespace moire {
namespace {

// Whether one is doubtful is kept in a word as wide as a double: compilers then keep it in vectors.
[[gnu::always_inline]] inline bool mark_above(const LineSign& line, std::span<const double> x,
                                              std::span<const double> y, std::uint8_t* __restrict inside) noexcept {
  const double nx = line.normal.x, ny = line.normal.y, c = line.offset, doubt = line.doubt;
  const double* __restrict px = x.data(), * __restrict py = y.data();
  const std::size_t n = x.size();
  std::int64_t doubtful = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const double s = nx * px[i] + ny * py[i] - c;
    inside[i] = s >= 0;
    doubtful |= std::fabs(s) <= doubt ? 1 : 0;
  }
  return doubtful != 0;
}

[[gnu::always_inline]] inline bool mark_within(const CircleSign& circle, std::span<const double> x,
                                               std::span<const double> y, std::uint8_t* __restrict inside) noexcept {
  const double cx = circle.twice_center.x, cy = circle.twice_center.y, power = circle.power, doubt = circle.doubt;
  const double* __restrict px = x.data(), * __restrict py = y.data();
  const std::size_t n = x.size();
  std::int64_t doubtful = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const double e = px[i] * (px[i] - cx) + py[i] * (py[i] - cy) - power;
    inside[i] = static_cast<std::uint8_t>(inside[i] | (e < -doubt ? 1 : 0));
    doubtful |= std::fabs(e) <= doubt ? 1 : 0;
  }
  return doubtful != 0;
}

// Rounded to an integer: exact for |v| < 2^51, to nearest.
[[gnu::always_inline]] inline double nearest_integer(double v) noexcept {
  constexpr double kMagic = 0x1.8p52;
  return (v + kMagic) - kMagic;
}

[[gnu::always_inline]] inline bool mark_squares(const BoardSign& board, std::span<const double> x,
                                                std::span<const double> y, std::uint8_t* __restrict inside) noexcept {
  const BoardSign b = board;
  const double* __restrict px = x.data(), * __restrict py = y.data();
  const std::size_t n = x.size();
  std::int64_t doubtful = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const double U = b.u.a * px[i] + b.u.b * py[i] + b.u.c;
    const double V = b.v.a * px[i] + b.v.b * py[i] + b.v.c;
    const double W = b.w.a * px[i] + b.w.b * py[i] + b.w.c;
    const double r = 1 / W, u = U * r, v = V * r;
    const double du = quotient_error(u, b.u.error, b.w.error, r), dv = quotient_error(v, b.v.error, b.w.error, r);
    // floor(), or off by one next to an integer, where the fraction shows it.
    const double k = nearest_integer(u - 0.5), l = nearest_integer(v - 0.5);
    const double fu = u - k, fv = v - l, half = 0.5 * (k + l);
    // Each 1 or 0, in words as wide as a double and without branches; 0 for what is no number.
    const auto holds = [](bool is) __attribute__((always_inline))->std::int64_t { return is ? 1 : 0; };
    const std::int64_t front =
        holds(W > 4 * b.w.error) & holds(std::fabs(u) < kMaxSquares) & holds(std::fabs(v) < kMaxSquares);
    const std::int64_t within = holds(fu > du) & holds(1 - fu > du) & holds(fv > dv) & holds(1 - fv > dv);
    const std::int64_t on_board =
        holds(u > b.u0 + du) & holds(u < b.u1 - du) & holds(v > b.v0 + dv) & holds(v < b.v1 - dv);
    const std::int64_t clear = front & within & on_board, behind = holds(W < -b.w.error),
                       even = holds(nearest_integer(half) == half);
    const std::int64_t doubt = 1 ^ (clear | behind);
    inside[i] = static_cast<std::uint8_t>((clear & even) | (doubt * kDoubtful));
    doubtful |= doubt;
  }
  return doubtful != 0;
}

bool above_plain(const LineSign& line, std::span<const double> x, std::span<const double> y,
                 std::uint8_t* inside) noexcept {
  return mark_above(line, x, y, inside);
}
bool squares_plain(const BoardSign& board, std::span<const double> x, std::span<const double> y,
                   std::uint8_t* inside) noexcept {
  return mark_squares(board, x, y, inside);
}
bool within_plain(const CircleSign& circle, std::span<const double> x, std::span<const double> y,
                  std::uint8_t* inside) noexcept {
  return mark_within(circle, x, y, inside);
}

#if MOIRE_HAS_AVX
[[MOIRE_AVX2]] bool above_avx2(const LineSign& line, std::span<const double> x, std::span<const double> y,
                               std::uint8_t* inside) noexcept {
  return mark_above(line, x, y, inside);
}
[[MOIRE_AVX2]] bool squares_avx2(const BoardSign& board, std::span<const double> x, std::span<const double> y,
                                 std::uint8_t* inside) noexcept {
  return mark_squares(board, x, y, inside);
}
[[MOIRE_AVX2]] bool within_avx2(const CircleSign& circle, std::span<const double> x, std::span<const double> y,
                                std::uint8_t* inside) noexcept {
  return mark_within(circle, x, y, inside);
}
[[MOIRE_AVX512]] bool above_avx512(const LineSign& line, std::span<const double> x, std::span<const double> y,
                                   std::uint8_t* inside) noexcept {
  return mark_above(line, x, y, inside);
}
[[MOIRE_AVX512]] bool squares_avx512(const BoardSign& board, std::span<const double> x, std::span<const double> y,
                                     std::uint8_t* inside) noexcept {
  return mark_squares(board, x, y, inside);
}
[[MOIRE_AVX512]] bool within_avx512(const CircleSign& circle, std::span<const double> x, std::span<const double> y,
                                    std::uint8_t* inside) noexcept {
  return mark_within(circle, x, y, inside);
}
constexpr SignLoops kLoops[] = {{above_plain, within_plain, squares_plain},
                                {above_avx2, within_avx2, squares_avx2},
                                {above_avx512, within_avx512, squares_avx512}};
#else
constexpr SignLoops kLoops[] = {{above_plain, within_plain, squares_plain}};
#endif

}  // namespace

std::span<const SignLoops> sign_loops() noexcept { return {kLoops, usable_sets()}; }

}  // namespace moire
