// The weights of a fixed set, summed over blocks; see weight_tree.h.
#include "engine/weight_tree.h"

#include <algorithm>
#include <cassert>
#include <numeric>

#include "core/instruction_sets.h"
#include "core/lanes.h"
#include "core/parallel.h"

namespace moire {
namespace {

constexpr std::size_t kChunk = 512;          // points weighed together
constexpr std::size_t kLeavesTogether = 64;  // and leaves summed together

constexpr std::size_t lanes_a_row(std::size_t side) { return (side + kLanes - 1) / kLanes; }

// out[j][i] = sum of kx[i] ky[j] over the chosen points, one after the other: the loop over points is outermost, each
// sum has a lane of its own. kSide is `side` where the sums fit in registers, and 0 for any other.
template <std::size_t kSide>
[[gnu::always_inline]] inline void add_products(const double* __restrict weights,
                                                const std::uint32_t* __restrict chosen, std::size_t count,
                                                std::size_t side, double* __restrict out) {
  if constexpr (kSide > 0) {
    constexpr std::size_t kRow = lanes_a_row(kSide), kPitch = kRow * kLanes, kStride = kPitch + kSide;
    Lanes sums[kSide][kRow] = {};
    for (std::size_t c = 0; c < count; ++c) {
      const double* point = weights + chosen[c] * kStride;
      Lanes kx[kRow];
      for (std::size_t i = 0; i < kRow; ++i) load(point + i * kLanes, kx[i]);
      for (std::size_t j = 0; j < kSide; ++j) {
        for (std::size_t i = 0; i < kRow; ++i) sums[j][i] += kx[i] * point[kPitch + j];
      }
    }
    for (std::size_t j = 0; j < kSide; ++j) {
      for (std::size_t i = 0; i < kRow; ++i) store(sums[j][i], out + j * kPitch + i * kLanes);
    }
  } else {
    const std::size_t pitch = lanes_a_row(side) * kLanes, stride = pitch + side;
    std::fill_n(out, side * pitch, 0.0);
    for (std::size_t c = 0; c < count; ++c) {
      const double* point = weights + chosen[c] * stride;
      for (std::size_t j = 0; j < side; ++j) {
        for (std::size_t i = 0; i < pitch; i += kLanes) {
          Lanes kx, sum;
          load(point + i, kx);
          load(out + j * pitch + i, sum);
          sum += kx * point[pitch + j];
          store(sum, out + j * pitch + i);
        }
      }
    }
  }
}

using Add = void (*)(const double*, const std::uint32_t*, std::size_t, std::size_t, double*);

template <std::size_t kSide>
void products_plain(const double* weights, const std::uint32_t* chosen, std::size_t count, std::size_t side,
                    double* out) {
  add_products<kSide>(weights, chosen, count, side, out);
}
#if MOIRE_HAS_AVX
template <std::size_t kSide>
[[MOIRE_AVX2]] void products_avx2(const double* weights, const std::uint32_t* chosen, std::size_t count,
                                  std::size_t side, double* out) {
  add_products<kSide>(weights, chosen, count, side, out);
}
template <std::size_t kSide>
[[MOIRE_AVX512]] void products_avx512(const double* weights, const std::uint32_t* chosen, std::size_t count,
                                      std::size_t side, double* out) {
  add_products<kSide>(weights, chosen, count, side, out);
}
template <std::size_t kSide>
constexpr Add kProducts[] = {products_plain<kSide>, products_avx2<kSide>, products_avx512<kSide>};
#else
template <std::size_t kSide>
constexpr Add kProducts[] = {products_plain<kSide>};
#endif

// out[j][i] = sum of k[j][i] over the chosen points, one after the other.
void add_radial(const double* weights, const std::uint32_t* chosen, std::size_t count, std::size_t side, double* out) {
  const std::size_t size = side * lanes_a_row(side) * kLanes;
  std::fill_n(out, size, 0.0);
  for (std::size_t c = 0; c < count; ++c) {
    const double* point = weights + chosen[c] * size;
    for (std::size_t i = 0; i < size; ++i) out[i] += point[i];
  }
}

// Numbers that a point's weights take.
constexpr std::size_t stride_of(std::size_t side, Symmetry symmetry) {
  const std::size_t pitch = lanes_a_row(side) * kLanes;
  return symmetry == Symmetry::radial ? side * pitch : pitch + side;
}

// Of n points: halved until the leaves have kLeafPoints on the average.
int depth_for(std::int64_t n) noexcept {
  int depth = 0;
  while ((n >> depth) > WeightTree::kLeafPoints) ++depth;
  return depth;
}

}  // namespace

bool WeightTree::fits(std::int64_t n, int reach, Symmetry symmetry) noexcept {
  const std::size_t side = 2 * static_cast<std::size_t>(reach) + 1, sum = stride_of(side, Symmetry::radial);
  const double blocks = static_cast<double>(std::int64_t{2} << depth_for(n));
  const double a_point = static_cast<double>(2 + stride_of(side, symmetry)) * sizeof(double) + sizeof(std::int32_t),
               a_block = static_cast<double>(sum) * sizeof(double) + sizeof(std::uint32_t);
  return static_cast<double>(n) * a_point + blocks * a_block <= kMaxBytes;
}

WeightTree::Add WeightTree::products_for(std::size_t side) noexcept {
  const std::size_t best = usable_sets() - 1;
  switch (side) {
    case 1:
      return kProducts<1>[best];
    case 3:
      return kProducts<3>[best];
    case 5:
      return kProducts<5>[best];
    case 7:
      return kProducts<7>[best];
    default:
      return kProducts<0>[best];
  }
}

WeightTree::WeightTree(const Filter& filter, std::span<const double> x, std::span<const double> y)
    : depth_(depth_for(static_cast<std::int64_t>(x.size()))),
      side_(static_cast<std::size_t>(2 * filter.apron() + 1)),
      pitch_(lanes_a_row(side_) * kLanes),
      stride_(stride_of(side_, filter.info().symmetry())),
      add_(filter.is_radial() ? add_radial : products_for(side_)) {
  assert(x.size() == y.size() && fits(static_cast<std::int64_t>(x.size()), filter.apron(), filter.info().symmetry()));
  sort(x, y);
  if (filter.is_radial()) {
    weigh_radial(filter.radial_kernel(), filter.apron());
  } else {
    weigh_separable(filter.kernel(), filter.apron());
  }
  add_up();

  const double r = filter.radius();
  const auto in_window = [r](double v) { return v - 0.5 >= -r && v - 0.5 < r; };
  own_before_.reserve(x.size() + 1);
  own_before_.push_back(0);
  for (std::size_t i = 0; i < x.size(); ++i) {
    own_before_.push_back(own_before_.back() + (in_window(x_[i]) && in_window(y_[i])));
  }
}

// Counting sort by leaf, which keeps the order within leaves.
void WeightTree::sort(std::span<const double> x, std::span<const double> y) {
  const auto leaf_of = [&](std::size_t i) {
    // Exact: products with powers of two. The leaf's number has the digits of column and row in turns.
    const auto column = static_cast<std::uint32_t>(x[i] * columns()), row = static_cast<std::uint32_t>(y[i] * rows());
    std::uint32_t leaf = 0;
    int column_digits = (depth_ + 1) / 2, row_digits = depth_ / 2;
    for (int level = 0; level < depth_; ++level) {
      leaf = leaf << 1 | ((level % 2 == 0 ? column >> --column_digits : row >> --row_digits) & 1);
    }
    return leaf;
  };
  const std::size_t n = x.size();
  std::vector<std::uint32_t> leaf(n);
  first_.assign((std::size_t{1} << depth_) + 1, 0);
  for (std::size_t i = 0; i < n; ++i) {
    leaf[i] = leaf_of(i);
    ++first_[leaf[i]];
  }
  std::uint32_t before = 0;
  for (std::uint32_t& v : first_) {
    before += v;
    v = before;
  }
  x_.resize(n);
  y_.resize(n);
  for (std::size_t i = n; i-- > 0;) {
    const std::size_t at = --first_[leaf[i]];
    x_[at] = x[i];
    y_[at] = y[i];
  }
}

void WeightTree::weigh_separable(const Kernel& kernel, int reach) {
  weights_ = std::make_unique_for_overwrite<double[]>(x_.size() * stride_);
  parallel_for((x_.size() + kChunk - 1) / kChunk, [&](std::size_t chunk) {
    const std::size_t first = chunk * kChunk, n = std::min(kChunk, x_.size() - first);
    double* const out = weights_.get() + first * stride_;
    std::vector<double> offset(n), k(side_ * n);
    const auto weigh_axis = [&](const double* coordinate, double* axis, std::size_t count) {
      for (std::size_t d = 0; d < side_; ++d) {
        // The point's distance from the centre of the pixel so many cells to the right (below).
        const double center = static_cast<double>(d) - reach + 0.5;
        for (std::size_t i = 0; i < n; ++i) offset[i] = coordinate[i] - center;
        kernel.weights(offset, {k.data() + d * n, n});
      }
      for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t d = 0; d < count; ++d) axis[i * stride_ + d] = d < side_ ? k[d * n + i] : 0.0;
      }
    };
    weigh_axis(x_.data() + first, out, pitch_);
    weigh_axis(y_.data() + first, out + pitch_, side_);
  });
}

void WeightTree::weigh_radial(const RadialKernel& kernel, int reach) {
  weights_ = std::make_unique_for_overwrite<double[]>(x_.size() * stride_);
  parallel_for((x_.size() + kChunk - 1) / kChunk, [&](std::size_t chunk) {
    const std::size_t first = chunk * kChunk, n = std::min(kChunk, x_.size() - first);
    double* const out = weights_.get() + first * stride_;
    std::vector<double> dx(n), dy(n), k(n);
    for (std::size_t at = 0; at < stride_; ++at) {
      const std::size_t column = at % pitch_, row = at / pitch_;
      if (column < side_) {
        // The pixel's centre, seen from the corner of the points' own pixel.
        const double center_x = static_cast<double>(column) - reach + 0.5,
                     center_y = static_cast<double>(row) - reach + 0.5;
        for (std::size_t i = 0; i < n; ++i) dx[i] = x_[first + i] - center_x;
        for (std::size_t i = 0; i < n; ++i) dy[i] = y_[first + i] - center_y;
        kernel.weights(dx, dy, k);
      }
      for (std::size_t i = 0; i < n; ++i) out[i * stride_ + at] = column < side_ ? k[i] : 0.0;
    }
  });
}

void WeightTree::add_up() {
  sums_ = std::make_unique_for_overwrite<double[]>(blocks() * sum_size());
  std::fill_n(sums_.get(), sum_size(), 0.0);  // block 0 is no block
  const std::uint32_t leaves = std::uint32_t{1} << depth_;
  const auto sum_leaf = [&](std::size_t i) {
    const auto leaf = leaves + static_cast<std::uint32_t>(i);
    std::vector<std::uint32_t> all(end(leaf) - begin(leaf));
    std::iota(all.begin(), all.end(), std::uint32_t{0});
    sum_chosen(leaf, all, sums_.get() + leaf * sum_size());
  };
  parallel_for(leaves, sum_leaf, kLeavesTogether);
  for (std::uint32_t block = leaves - 1; block > 0; --block) {
    const double *a = sum(2 * block), *b = sum(2 * block + 1);
    double* out = sums_.get() + block * sum_size();
    for (std::size_t i = 0; i < sum_size(); ++i) out[i] = a[i] + b[i];
  }
}

}  // namespace moire
