// How many of a pattern's samples in a pixel are inside a scene: all that the unit box asks. Either every sample is
// tested, or cells of the pattern that the scene holds as wholes are counted, those outside are passed over, and only
// the samples of cells that the boundary may cross are made and tested. Both give the same count.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/geometry.h"
#include "patterns/pattern.h"
#include "testimages/testimage.h"

namespace moire {

// One thread's working memory. Precondition: the scene stands still.
class BoxCounter {
 public:
  BoxCounter(const TestImage& scene, const Pattern& pattern);

  // Samples inside, of each of the pixels x0 <= x < x1 of row y; tests all.
  void test_all(int x0, int x1, int y, std::span<std::int64_t> inside);

  // Whether cells may help somewhere.
  bool has_cells() const noexcept { return has_cells_; }

  struct Count {
    std::int64_t inside = 0, tested = 0;
  };
  // Precondition: has_cells().
  Count test_crossed(Pixel pixel);

 private:
  // Of a row's columns as seen in the pixel: those that the scene may touch, and those of them that it holds as wholes.
  struct Columns {
    std::int32_t begin, end, whole_begin, whole_end;
  };

  bool find_cells(Pixel pixel, const CellGrid& grid);
  bool find_by_strips(Pixel pixel);
  Cover cover_of(const Columns& c) const noexcept;
  void add_row(std::int32_t row, Columns c);
  bool halve(Pixel pixel, int x0, int x1, int y0, int y1);

  const TestImage& scene_;
  const Pattern& pattern_;
  std::size_t n_;
  int looks_;  // calls of cover() that a pixel is worth
  bool has_cells_;
  std::unique_ptr<double[]> x_, y_;
  std::unique_ptr<std::uint8_t[]> inside_;
  std::vector<Pixel> run_;

  CellGrid grid_;              // of the pixel, or of the one before
  std::vector<double> sides_;  // of its rows
  std::vector<double> strips_;
  std::vector<Columns> columns_;  // by row
  std::vector<CellSpan> whole_, crossed_;
  int looks_left_ = 0;
};

}  // namespace moire
