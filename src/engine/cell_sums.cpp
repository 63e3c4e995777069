#include "engine/cell_sums.h"

#include <algorithm>

#include "core/instruction_sets.h"
#include "core/lanes.h"
#include "engine/count_inside.h"

namespace moire {
namespace {

constexpr std::size_t kSums = 2 * kLanes;  // interleaved partial sums
constexpr std::size_t kChunk = 512;        // a multiple of kSums: chunks do not change which sum a sample goes to

double fold(const double* s) { return ((s[0] + s[4]) + (s[2] + s[6])) + ((s[1] + s[5]) + (s[3] + s[7])); }

// Adds the samples' weights wx wy, of a radial filter w 1, to the first eight sums, and those of samples inside, f = 1,
// to the next eight.
[[gnu::always_inline]] inline void add_products(const double* __restrict wx, const double* __restrict wy,
                                                const double* __restrict f, std::size_t n, double* __restrict sums) {
  Lanes k_low, k_high, kf_low, kf_high;
  load(sums, k_low);
  load(sums + kLanes, k_high);
  load(sums + kSums, kf_low);
  load(sums + kSums + kLanes, kf_high);
  const auto add = [&](std::size_t i, Lanes& k_sum, Lanes& kf_sum) {
    Lanes x, y, inside;
    load(wx + i, x);
    load(wy + i, y);
    load(f + i, inside);
    const Lanes k = x * y;
    k_sum += k;
    kf_sum += k * inside;
  };
  std::size_t i = 0;
  for (; i + kSums <= n; i += kSums) {
    add(i, k_low, kf_low);
    add(i + kLanes, k_high, kf_high);
  }
  store(k_low, sums);
  store(k_high, sums + kLanes);
  store(kf_low, sums + kSums);
  store(kf_high, sums + kSums + kLanes);
  for (std::size_t sum = 0; i < n; ++i, ++sum) {
    const double k = wx[i] * wy[i];
    sums[sum] += k;
    sums[kSums + sum] += k * f[i];
  }
}

using Products = void (*)(const double*, const double*, const double*, std::size_t, double*);

void products_plain(const double* wx, const double* wy, const double* f, std::size_t n, double* sums) {
  add_products(wx, wy, f, n, sums);
}
#if MOIRE_HAS_AVX
[[MOIRE_AVX2]] void products_avx2(const double* wx, const double* wy, const double* f, std::size_t n, double* sums) {
  add_products(wx, wy, f, n, sums);
}
[[MOIRE_AVX512]] void products_avx512(const double* wx, const double* wy, const double* f, std::size_t n,
                                      double* sums) {
  add_products(wx, wy, f, n, sums);
}
constexpr Products kProducts[] = {products_plain, products_avx2, products_avx512};
#else
constexpr Products kProducts[] = {products_plain};
#endif

void multiply(const double* wx, const double* wy, const double* f, std::size_t n, double* sums) {
  static const Products best = kProducts[usable_sets() - 1];
  best(wx, wy, f, n, sums);
}

}  // namespace

CellSums::CellSums(const Filter& filter)
    : filter_(filter),
      reach_(filter.apron()),
      side_(static_cast<std::size_t>(2 * reach_ + 1)),
      unit_box_(filter.is_unit_box()) {
  offset_x_.resize(kChunk);
  inside_.resize(kChunk);
  partial_.resize(side_ * side_ * 2 * kSums);
  if (filter.is_radial()) {
    offset_y_.resize(kChunk);
    ones_.assign(kChunk, 1.0);
    weighed_.resize(side_ * side_);
  } else {
    kx_.resize(side_ * kChunk);
    ky_.resize(side_ * kChunk);
  }
}

void CellSums::take(std::span<const double> x, std::span<const double> y) {
  if (filter_.is_radial()) {
    take_radial(x, y);
  } else {
    take_separable(x, taken_x_, kx_);
    take_separable(y, taken_y_, ky_);
  }
}

CellSums::Factors CellSums::factors(std::size_t p) {
  if (filter_.is_radial()) return {radial_weights(p), ones_.data()};
  return {kx_.data() + (p % side_) * kChunk, ky_.data() + (p / side_) * kChunk};
}

void CellSums::take_separable(std::span<const double> coordinate, std::vector<double>& taken,
                              std::vector<double>& weights) {
  if (std::equal(coordinate.begin(), coordinate.end(), taken.begin(), taken.end())) return;
  taken.assign(coordinate.begin(), coordinate.end());
  for (int d = -reach_; d <= reach_; ++d) {
    // The sample's distance from the centre of the pixel d cells to the right (below).
    for (std::size_t i = 0; i < coordinate.size(); ++i) offset_x_[i] = coordinate[i] - (d + 0.5);
    filter_.kernel().weights({offset_x_.data(), coordinate.size()},
                             {weights.data() + static_cast<std::size_t>(d + reach_) * kChunk, coordinate.size()});
  }
}

void CellSums::take_radial(std::span<const double> x, std::span<const double> y) {
  if (std::equal(x.begin(), x.end(), taken_x_.begin(), taken_x_.end()) &&
      std::equal(y.begin(), y.end(), taken_y_.begin(), taken_y_.end())) {
    return;
  }
  taken_x_.assign(x.begin(), x.end());
  taken_y_.assign(y.begin(), y.end());
  std::fill(weighed_.begin(), weighed_.end(), std::uint8_t{0});
  // As much as these samples need: whole chunks for side^2 pixels would be 70 MB under a radius of 64.
  if (kr_.size() < side_ * side_ * x.size()) kr_.resize(side_ * side_ * x.size());
}

const double* CellSums::radial_weights(std::size_t p) {
  const std::size_t n = taken_x_.size();
  double* const weights = kr_.data() + p * n;
  if (weighed_[p] == 0) {
    // The pixel's centre, seen from the cell's corner.
    const double center_x = static_cast<double>(p % side_) - reach_ + 0.5,
                 center_y = static_cast<double>(p / side_) - reach_ + 0.5;
    for (std::size_t i = 0; i < n; ++i) offset_x_[i] = taken_x_[i] - center_x;
    for (std::size_t i = 0; i < n; ++i) offset_y_[i] = taken_y_[i] - center_y;
    filter_.radial_kernel().weights({offset_x_.data(), n}, {offset_y_.data(), n}, {weights, n});
    weighed_[p] = 1;
  }
  return weights;
}

// The window is a square, also of a radial filter: what lies in its corners has no weight, but counts.
void CellSums::count_own(std::span<const double> x, std::span<const double> y, std::span<const std::uint8_t> inside,
                         OwnCount& own) const {
  const double r = filter_.radius();
  if (r >= 0.5) {  // the window holds the whole cell
    own.samples += static_cast<std::int64_t>(x.size());
    own.inside += count_inside(inside);
    return;
  }
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double dx = x[i] - 0.5, dy = y[i] - 0.5;
    if (dx >= -r && dx < r && dy >= -r && dy < r) {
      ++own.samples;
      own.inside += inside[i];
    }
  }
}

void CellSums::operator()(std::span<const double> x, std::span<const double> y, std::span<const std::uint8_t> inside,
                          std::span<const std::uint8_t> needed, std::span<WeightSum> sums, OwnCount& own) {
  own = {};
  if (unit_box_) {
    // Every weight is exactly 1: the sums are counts, exact in any order.
    own.inside = count_inside(inside);
    own.samples = static_cast<std::int64_t>(inside.size());
    sums[0] = {static_cast<double>(own.samples), static_cast<double>(own.inside)};
    return;
  }
  std::fill(partial_.begin(), partial_.end(), 0.0);
  for (std::size_t first = 0; first < x.size(); first += kChunk) {
    const std::size_t n = std::min(kChunk, x.size() - first);
    take(x.subspan(first, n), y.subspan(first, n));
    count_own(x.subspan(first, n), y.subspan(first, n), inside.subspan(first, n), own);
    std::copy_n(inside.begin() + static_cast<std::ptrdiff_t>(first), n, inside_.begin());
    for (std::size_t p = 0; p < side_ * side_; ++p) {
      if (needed[p] == 0) continue;
      const Factors k = factors(p);
      multiply(k.first, k.second, inside_.data(), n, partial_.data() + p * 2 * kSums);
    }
  }
  for (std::size_t p = 0; p < side_ * side_; ++p) {
    if (needed[p] != 0)
      sums[p] = {fold(partial_.data() + p * 2 * kSums), fold(partial_.data() + p * 2 * kSums + kSums)};
  }
}

}  // namespace moire
