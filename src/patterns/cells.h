// How the points of one pixel lie in the cells of a grid, for a pattern that knows it: the points of many cells can
// then be counted and those of a few looked at, without making the others.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace moire {

// Cell (i, j) of a pixel is [(i - right) / columns, (i + 1 - right) / columns] times [(j - down) / rows, (j + 1 - down)
// / rows], cut to the pixel; right and down in [0, 1). Where right is not 0 the grid lies across the pixel's side as on
// a torus: then there is a column more, and columns 0 and `columns` are two parts of one, whose points may be in
// either. So are rows 0 and `rows` where down is not 0.
//
// Points have y from side(j) to side(j + 1) of their row, as doubles, both ends included; x up to 2^-50 beyond the
// cell's sides.
struct CellGrid {
  int columns = 0, rows = 0;  // 0: nothing is known about this pixel
  double right = 0, down = 0;

  // Rows and columns that are seen in the pixel, parts among them.
  int seen_columns() const noexcept { return columns + (right > 0); }
  int seen_rows() const noexcept { return rows + (down > 0); }
  // Where row j begins, from the pixel's upper side.
  double side(int j) const noexcept { return std::clamp((j - down) / rows, 0.0, 1.0); }

  friend bool operator==(const CellGrid&, const CellGrid&) = default;
};

// Cells begin <= i < end of a row. Of a column or row in two parts either names the whole.
struct CellSpan {
  std::int32_t row, begin, end;
};

// What was found in cells: `counted` points in those to be counted, `filled` points written of those to be filled.
struct CellPoints {
  std::int64_t counted = 0;
  std::size_t filled = 0;
};

}  // namespace moire
