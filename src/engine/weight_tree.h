// The filter weights of a set of points that is the same in every pixel, summed once over the blocks of a binary tree:
// what a cell sums to is then known without looking at the points of blocks that the scene holds as wholes.
//
// The pixel is halved, in x first, then in y and so on, as the tree of a k-d search (J. L. Bentley, "Multidimensional
// binary search trees used for associative searching", CACM 18, 1975) cut in the middles. Block 1 is the pixel, blocks
// 2 b and 2 b + 1 are the halves of block b, the left or upper one first; the last level's blocks are leaves.
//
// What a sum over points IS, to the last bit: in a leaf, the chosen points one after the other; in a block, the sum of
// its first half plus that of its second. So sums over some of the points do not depend on which blocks were taken as
// wholes. Errors grow with the depth, not with the number of points: at most (points in a leaf + depth) 2^-53 of the
// sum of absolute weights.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "filters/filter.h"

namespace moire {

class WeightTree {
 public:
  // Leaves have at most so many points on the average. Measured with mitchell on a disk: 8 and 16 are slower by up to a
  // half at 65,536 points, 64 gains nothing; at 16 to 1,024 points there is little between them.
  static constexpr int kLeafPoints = 32;
  // Largest tree, bytes: under a kernel of 5 x 5 cells some 400,000 points, 180,000 if it is radial.
  static constexpr double kMaxBytes = 64 << 20;

  // Whether a set of n points is worth its memory, for filters whose apron is `reach` pixels: a point's weights under a
  // separable one are kept by column and row, under a radial one for each pixel.
  static bool fits(std::int64_t n, int reach, Symmetry symmetry) noexcept;

  // x and y of the points, in [0, 1) from the pixel's corner; |dx|, |dy| <= reach = filter.apron() are the offsets of
  // the pixels whose weights are summed, as in CellSums. Precondition: fits().
  WeightTree(const Filter& filter, std::span<const double> x, std::span<const double> y);

  // Levels below block 1, which has level 0.
  int depth() const noexcept { return depth_; }
  bool is_leaf(std::uint32_t block) const noexcept { return (block >> depth_) != 0; }
  std::uint32_t blocks() const noexcept { return std::uint32_t{2} << depth_; }  // the unused block 0 among them
  // Blocks of the last level in a row and in a column: cells of equal size.
  int columns() const noexcept { return 1 << ((depth_ + 1) / 2); }
  int rows() const noexcept { return 1 << (depth_ / 2); }

  // The points in the order of the leaves, those of a leaf in the order in which they were given.
  std::span<const double> x() const noexcept { return x_; }
  std::span<const double> y() const noexcept { return y_; }
  // A block has those from begin(block) to end(block).
  std::size_t begin(std::uint32_t block) const noexcept { return first_[first_leaf(block, 0)]; }
  std::size_t end(std::uint32_t block) const noexcept { return first_[first_leaf(block, 1)]; }

  // Sums have one number for each offset, that of (dx, dy) at (dy + reach) * pitch() + dx + reach, with zeros behind
  // each row; sum_size() numbers in all. None of them is ever -0.
  std::size_t side() const noexcept { return side_; }
  std::size_t pitch() const noexcept { return pitch_; }
  std::size_t sum_size() const noexcept { return side_ * pitch_; }
  // Over all points of a block.
  const double* sum(std::uint32_t block) const noexcept { return sums_.get() + block * sum_size(); }
  // Over some points of a leaf, given by their numbers in the leaf, ascending.
  void sum_chosen(std::uint32_t leaf, std::span<const std::uint32_t> chosen, double* out) const noexcept {
    add_(weights_.get() + begin(leaf) * stride_, chosen.data(), chosen.size(), side_, out);
  }

  // Of points begin <= i < end, those inside the window of their own pixel.
  std::int64_t own(std::size_t begin, std::size_t end) const noexcept { return own_before_[end] - own_before_[begin]; }

 private:
  using Add = void (*)(const double* weights, const std::uint32_t* chosen, std::size_t count, std::size_t side,
                       double* out);
  static Add products_for(std::size_t side) noexcept;

  // Of a block, or of the one so many behind it on its level: the number of its first leaf, from 0.
  std::size_t first_leaf(std::uint32_t block, std::size_t behind) const noexcept {
    const int levels_down = depth_ + 1 - static_cast<int>(std::bit_width(block));
    return ((block + behind) << levels_down) - (std::size_t{1} << depth_);
  }
  void sort(std::span<const double> x, std::span<const double> y);
  void weigh_separable(const Kernel& kernel, int reach);
  void weigh_radial(const RadialKernel& kernel, int reach);
  void add_up();

  int depth_ = 0;
  std::size_t side_, pitch_, stride_;  // stride: numbers that a point has in weights_
  Add add_;
  std::vector<std::uint32_t> first_;  // point of each leaf, and their number
  std::vector<double> x_, y_;
  // Of each point: pitch k(x - dx - 1/2), then side k(y - dy - 1/2); of a radial filter one for each offset, as sums
  // have them. Not initialised, so that threads touch it first.
  std::unique_ptr<double[]> weights_;
  std::unique_ptr<double[]> sums_;  // by block
  std::vector<std::int32_t> own_before_;
};

}  // namespace moire
