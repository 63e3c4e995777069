// Image space: x to the right, y down, unit = one pixel; pixel (i, j) covers [i, i+1) x [j, j+1).
#pragma once

#include <cstdint>

namespace moire {

struct Vec2 {
  double x = 0, y = 0;
  friend bool operator==(const Vec2&, const Vec2&) = default;
};

// A closed rectangle, lo <= hi in both axes.
struct Rect {
  Vec2 lo, hi;
};

// A pixel by its integer coordinates; any 64-bit integers, also outside the image.
struct Pixel {
  std::int64_t x = 0, y = 0;
  friend bool operator==(const Pixel&, const Pixel&) = default;
};

// Size of an image in pixels, both at least 1.
struct Grid {
  int width = 1, height = 1;
  friend bool operator==(const Grid&, const Grid&) = default;
};

}  // namespace moire
