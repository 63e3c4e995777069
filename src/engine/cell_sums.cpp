#include "engine/cell_sums.h"

#include <algorithm>

namespace moire {
namespace {

constexpr std::size_t kLanes = 8;
constexpr std::size_t kChunk = 512;  // a multiple of kLanes: chunks do not change which sum a sample goes to

double fold(const double* s) { return ((s[0] + s[4]) + (s[2] + s[6])) + ((s[1] + s[5]) + (s[3] + s[7])); }

}  // namespace

CellSums::CellSums(const Kernel& kernel, int reach) : kernel_(kernel), reach_(reach) {
  const auto side = static_cast<std::size_t>(2 * reach + 1);
  offset_.resize(kChunk);
  kx_.resize(side * kChunk);
  ky_.resize(side * kChunk);
  partial_.resize(side * side * 2 * kLanes);
}

void CellSums::weigh(std::span<const double> coordinate, std::vector<double>& weighed, std::vector<double>& weights) {
  if (std::equal(coordinate.begin(), coordinate.end(), weighed.begin(), weighed.end())) return;
  weighed.assign(coordinate.begin(), coordinate.end());
  for (int d = -reach_; d <= reach_; ++d) {
    // The sample's distance from the centre of the pixel d cells to the right (below).
    for (std::size_t i = 0; i < coordinate.size(); ++i) offset_[i] = coordinate[i] - (d + 0.5);
    kernel_.weights({offset_.data(), coordinate.size()},
                    {weights.data() + static_cast<std::size_t>(d + reach_) * kChunk, coordinate.size()});
  }
}

void CellSums::operator()(std::span<const double> x, std::span<const double> y, std::span<const std::uint8_t> inside,
                          std::span<const std::uint8_t> needed, std::span<WeightSum> sums, OwnCount& own) {
  own = {};
  if (kernel_.is_unit_box()) {
    // Every weight is exactly 1: the sums are counts, exact in any order.
    for (const std::uint8_t f : inside) own.inside += f;
    own.samples = static_cast<std::int64_t>(inside.size());
    sums[0] = {static_cast<double>(own.samples), static_cast<double>(own.inside)};
    return;
  }
  const auto side = static_cast<std::size_t>(2 * reach_ + 1);
  std::fill(partial_.begin(), partial_.end(), 0.0);
  for (std::size_t first = 0; first < x.size(); first += kChunk) {
    const std::size_t n = std::min(kChunk, x.size() - first);
    weigh(x.subspan(first, n), weighed_x_, kx_);
    weigh(y.subspan(first, n), weighed_y_, ky_);
    for (std::size_t i = 0; i < n; ++i) {
      const double dx = x[first + i] - 0.5, dy = y[first + i] - 0.5, r = kernel_.radius();
      if (dx >= -r && dx < r && dy >= -r && dy < r) {
        ++own.samples;
        own.inside += inside[first + i];
      }
    }
    for (std::size_t p = 0; p < side * side; ++p) {
      if (needed[p] == 0) continue;
      const double* __restrict wx = kx_.data() + (p % side) * kChunk;
      const double* __restrict wy = ky_.data() + (p / side) * kChunk;
      const std::uint8_t* __restrict f = inside.data() + first;
      double* __restrict k_sum = partial_.data() + p * 2 * kLanes;
      double* __restrict kf_sum = k_sum + kLanes;
      std::size_t i = 0;
      for (; i + kLanes <= n; i += kLanes) {
        for (std::size_t lane = 0; lane < kLanes; ++lane) {
          const double k = wx[i + lane] * wy[i + lane];
          k_sum[lane] += k;
          kf_sum[lane] += k * static_cast<double>(f[i + lane]);
        }
      }
      for (; i < n; ++i) {
        const double k = wx[i] * wy[i];
        k_sum[i % kLanes] += k;
        kf_sum[i % kLanes] += k * static_cast<double>(f[i]);
      }
    }
  }
  for (std::size_t p = 0; p < side * side; ++p) {
    if (needed[p] != 0)
      sums[p] = {fold(partial_.data() + p * 2 * kLanes), fold(partial_.data() + p * 2 * kLanes + kLanes)};
  }
}

}  // namespace moire
