// Weighted sums of one cell's samples for every pixel whose window touches the cell: the only place where samples are
// weighed. The order of additions is fixed: eight interleaved partial sums per pixel, sample i in sum i mod 8, folded
// as ((0 + 4) + (2 + 6)) + ((1 + 5) + (3 + 7)). So neither the SIMD width nor what else is computed changes a bit.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "filters/kernel.h"

namespace moire {

// For one cell and one pixel: sum of k over the cell's samples, and of k f, f = 1 inside the scene and 0 outside.
struct WeightSum {
  double k = 0, kf = 0;
};

// The cell's samples that lie inside its own pixel's window, and those of them that are inside the scene.
struct OwnCount {
  std::int64_t samples = 0, inside = 0;
};

class CellSums {
 public:
  // Pixels up to `reach` cells away in x and y can touch a cell: the filter's apron.
  CellSums(const Kernel& kernel, int reach);

  // x, y: the cell's samples, from its corner; inside: 1 or 0. For each pixel at offset (dx, dy) from the cell, |dx|,
  // |dy|
  // <= reach, whose needed[(dy + reach) * side + dx + reach] is not 0, writes sums at the same place; side = 2 reach
  // + 1.
  void operator()(std::span<const double> x, std::span<const double> y, std::span<const std::uint8_t> inside,
                  std::span<const std::uint8_t> needed, std::span<WeightSum> sums, OwnCount& own);

 private:
  const Kernel& kernel_;
  int reach_;
  void count_own(std::span<const double> x, std::span<const double> y, std::span<const std::uint8_t> inside,
                 OwnCount& own) const;
  void weigh(std::span<const double> coordinate, std::vector<double>& weighed, std::vector<double>& weights);

  // The coordinates of the chunk that kx_ and ky_ belong to: a pattern with the same points in every cell is weighed
  // once.
  std::vector<double> weighed_x_, weighed_y_;
  std::vector<double> inside_;            // of a chunk of samples, 1 or 0
  std::vector<double> offset_, kx_, ky_;  // weights of a chunk of samples, by pixel offset
  std::vector<double> partial_;           // eight sums of k, then eight of k f, by needed pixel
};

}  // namespace moire
