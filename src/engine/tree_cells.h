// Weighted sums of cells whose points are the same in every pixel, from a weight tree: either every point is tested, or
// blocks that the scene holds as wholes take their stored sums, those outside it count nothing, and only the points of
// leaves that the boundary may cross are tested. Both give the same sums to the last bit.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/cell_sums.h"
#include "engine/weight_tree.h"
#include "testimages/testimage.h"

namespace moire {

// One thread's working memory. Precondition: the scene stands still.
class TreeCells {
 public:
  TreeCells(const TestImage& scene, const WeightTree& tree);

  // Writes the sums for all side^2 pixels around, in the places of CellSums, and returns how many points were tested.
  std::int64_t test_all(Pixel pixel, std::span<WeightSum> sums, OwnCount& own);
  std::int64_t test_crossed(Pixel pixel, std::span<WeightSum> sums, OwnCount& own);

 private:
  // A block as it lies in the pixel: column and row among the blocks of its level.
  struct Place {
    std::uint32_t block = 1;
    int level = 0;
    std::uint32_t column = 0, row = 0;
    Place half(std::uint32_t which) const noexcept;
    Rect rect() const noexcept;
  };

  // By blocks of rows, block s of them the union of blocks 2 s and 2 s + 1: what testimage.h promises of strips.
  struct RowBlocks {
    std::vector<double> outer_begin, outer_end, inner_begin, inner_end;
  };

  bool find_strips(Pixel pixel);
  Cover cover_by_strips(const Place& place) const noexcept;
  Cover look(Pixel pixel, const Place& place);
  void find_crossed(Pixel pixel, const Place& place, bool by_strips);
  const double* sum_up(std::span<const Cover> covers, std::uint32_t block, double* out, double* scratch);
  const double* sum_leaf(std::uint32_t leaf, double* out);
  void write(const double* kf, std::span<WeightSum> sums, OwnCount& own) const;

  const TestImage& scene_;
  const WeightTree& tree_;
  std::int64_t looks_;          // calls of cover() that a pixel is worth
  std::size_t samples_a_look_;  // and the fewest points of a block that is worth one
  std::vector<double> sides_;   // of rows of leaves
  RowBlocks strips_;
  std::vector<Cover> found_, all_partial_;  // by block
  std::vector<double> x_, y_;               // of the points to be tested, in the order of leaves
  std::vector<std::uint8_t> inside_;        // of these points
  std::vector<std::uint32_t> chosen_;       // of a leaf
  std::vector<double> sums_;                // of block 1, and one more for each level

  // Of the pixel in hand.
  std::int64_t looks_left_ = 0;
  std::size_t taken_ = 0;  // points of inside_ used up
  std::int64_t own_inside_ = 0;
};

}  // namespace moire
