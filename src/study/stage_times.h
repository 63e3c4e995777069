// What sampling costs by stage: making the points, testing them against the scene, weighing them. Each stage is timed
// by itself, in passes apart from render(), which knows no clock.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/active_rows.h"
#include "engine/samples.h"
#include "filters/filter.h"
#include "testimages/testimage.h"

namespace moire {

// The cells that windows of active pixels touch, row-major: all that render() may need of an estimator that is exact on
// flat windows.
class ActiveCells {
 public:
  // `reach` is the filter's apron.
  ActiveCells(const ActiveRows& rows, int reach);

  // Cells x0 <= x < x1 of row y, of which the leftmost has the index `first`.
  struct Stretch {
    int x0, x1, y;
    std::size_t first;
  };
  std::span<const Stretch> stretches() const noexcept { return stretches_; }
  std::size_t size() const noexcept { return needed_.size() / side_ / side_; }
  int reach() const noexcept { return reach_; }
  // Which pixels around the cell are active: (2 reach + 1)^2 flags as CellSums wants them.
  std::span<const std::uint8_t> needed(std::size_t cell) const noexcept {
    return {needed_.data() + cell * side_ * side_, side_ * side_};
  }

 private:
  int reach_;
  std::size_t side_;
  std::vector<Stretch> stretches_;
  std::vector<std::uint8_t> needed_;
};

// What it costs to take every sample by itself. render() has shorter ways, of which these times say nothing: it counts
// whole cells of samples under a box, and of patterns that are the same in every pixel it adds whole branches of a tree
// of weights (engine/weight_tree.h).
//
// Wall times of one pass over all samples of the cells on the calling thread, in blocks as render() takes them: cells
// side by side, about 1024 samples, or fewer where a stretch ends. Looking at the clock takes some 25 ns, as long as a
// short block; it is measured beside each block and taken off the stages, down to 0.
struct StageTimes {
  std::int64_t samples = 0;
  std::int64_t generation_ns = 0;      // Samples::get
  std::int64_t evaluation_ns = 0;      // TestImage::contains
  std::int64_t reconstruction_ns = 0;  // CellSums: weights of the samples for the active pixels around, and their sums
};

// Wall time of making the samples of all cells once, in such blocks; with their times if `with_time`.
std::int64_t time_generation(Samples samples, const ActiveCells& cells, bool with_time);

// `cells` must be those of the scene and of filter.apron(); of a moving scene samples.has_time() must hold.
StageTimes time_stages(const TestImage& scene, Samples samples, const Filter& filter, const ActiveCells& cells);

}  // namespace moire
