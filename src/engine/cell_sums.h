// Weighted sums of one cell's samples for every pixel whose window touches the cell: the only place where samples are
// weighed. The order of additions is fixed: eight interleaved partial sums per pixel, sample i in sum i mod 8, folded
// as ((0 + 4) + (2 + 6)) + ((1 + 5) + (3 + 7)). So neither the SIMD width nor what else is computed changes a bit.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "filters/filter.h"

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
  // The filter must outlive it. Pixels up to reach = filter.apron() cells away in x and y can touch a cell, under a
  // radial filter, too.
  explicit CellSums(const Filter& filter);

  // x, y: the cell's samples, from its corner; inside: 1 or 0. For each pixel at offset (dx, dy) from the cell whose
  // needed[(dy + reach) * side + dx + reach] is not 0, writes sums at the same place: |dx|, |dy| <= reach, side = 2
  // reach + 1.
  void operator()(std::span<const double> x, std::span<const double> y, std::span<const std::uint8_t> inside,
                  std::span<const std::uint8_t> needed, std::span<WeightSum> sums, OwnCount& own);

 private:
  // A chunk's weights for one pixel, each the product of two factors: k(dx) and k(dy), or k(r) and 1.
  struct Factors {
    const double *first, *second;
  };

  void count_own(std::span<const double> x, std::span<const double> y, std::span<const std::uint8_t> inside,
                 OwnCount& own) const;
  // Takes up a chunk of samples; factors() then gives its weights for the pixel whose place in `needed` is p.
  void take(std::span<const double> x, std::span<const double> y);
  Factors factors(std::size_t p);
  void take_separable(std::span<const double> coordinate, std::vector<double>& taken, std::vector<double>& weights);
  void take_radial(std::span<const double> x, std::span<const double> y);
  const double* radial_weights(std::size_t p);

  const Filter& filter_;
  int reach_;
  std::size_t side_;
  bool unit_box_;
  // The coordinates of the chunk that the weights belong to: a pattern with the same points in every cell is weighed
  // once.
  std::vector<double> taken_x_, taken_y_;
  std::vector<double> inside_;  // of a chunk of samples, 1 or 0
  std::vector<double> offset_x_, offset_y_;
  std::vector<double> kx_, ky_;        // separable: weights of a chunk of samples, by column and row of pixels
  std::vector<double> kr_, ones_;      // radial: weights of a chunk of samples, by pixel where weighed_ says so
  std::vector<std::uint8_t> weighed_;  // only what is needed, as there are side^2 of them
  std::vector<double> partial_;        // eight sums of k, then eight of k f, by needed pixel
};

}  // namespace moire
