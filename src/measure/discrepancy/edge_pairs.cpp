// Distances of pairs, and the probability that the printed generator's line separates them.
#include "measure/discrepancy/edge_pairs.h"

#include <cmath>

namespace moire {
namespace {

struct Distance {
  [[gnu::always_inline]] double operator()(double dx, double dy) const noexcept { return std::sqrt(dx * dx + dy * dy); }
};

// The lines y = m x + b that D. P. Mitchell's generator draws have directions with density 1 / max(|cos|, |sin|)^2 and,
// given their direction, uniform places. With u >= v >= 0 the larger and the smaller of |dx| and |dy| they separate two
// points with the probability h = ((u - v) + (u + v) ln(1 + v/u)) / 2.
struct Separation {
  [[gnu::always_inline]] double operator()(double dx, double dy) const noexcept {
    // atanh(s) / s in powers of s^2, s <= 1/3: Chebyshev's expansion over [0, 1/9], cut after 11 terms and with its
    // coefficients rounded, is within 2.5e-18.
    constexpr double kAtanh[] = {0x1p+0,
                                 0x1.5555555555526p-2,
                                 0x1.99999999a1ed1p-3,
                                 0x1.2492492009c9cp-3,
                                 0x1.c71c744e01706p-4,
                                 0x1.745cae5cdec88p-4,
                                 0x1.3b1e423307d9fp-4,
                                 0x1.10632786a2475p-4,
                                 0x1.f01958209fc71p-5,
                                 0x1.54b093b32599bp-5,
                                 0x1.5d5192c5c16ebp-4};
    const double a = std::fabs(dx), b = std::fabs(dy);
    const double u = a > b ? a : b, v = a > b ? b : a, sum = u + v;
    // ln(1 + v/u) = 2 atanh(s); points that coincide have v = 0, and the least number keeps 0/0 away.
    const double s = v / (sum + u + 0x1p-1022), z = s * s;
    double series = kAtanh[10];
    for (int k = 9; k >= 0; --k) series = series * z + kAtanh[k];
    return 0.5 * (u - v) + sum * (s * series);
  }
};

Dd distances_plain(PairBlock rows, PairBlock columns) { return sum_of_tile(Distance{}, rows, columns); }
Dd separations_plain(PairBlock rows, PairBlock columns) { return sum_of_tile(Separation{}, rows, columns); }

#if defined(__x86_64__)
[[gnu::target("avx2")]] Dd distances_avx2(PairBlock rows, PairBlock columns) {
  return sum_of_tile(Distance{}, rows, columns);
}
[[gnu::target("avx2")]] Dd separations_avx2(PairBlock rows, PairBlock columns) {
  return sum_of_tile(Separation{}, rows, columns);
}
constexpr PairTile kDistances[] = {distances_plain, distances_avx2};
constexpr PairTile kSeparations[] = {separations_plain, separations_avx2};
std::size_t usable() { return __builtin_cpu_supports("avx2") ? 2 : 1; }
#else
constexpr PairTile kDistances[] = {distances_plain};
constexpr PairTile kSeparations[] = {separations_plain};
std::size_t usable() { return 1; }
#endif

}  // namespace

std::span<const PairTile> edge_pair_tiles(LineLaw law) {
  return law == LineLaw::isotropic ? std::span<const PairTile>(kDistances, usable())
                                   : std::span<const PairTile>(kSeparations, usable());
}

}  // namespace moire
