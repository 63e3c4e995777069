// Points for the micro-benchmarks.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "patterns/pattern.h"

namespace moire::bench {

// n points of a pattern in each pixel of a run along a row.
struct RunPoints {
  std::vector<Pixel> pixels;
  std::vector<double> x, y;

  RunPoints(const Pattern& pattern, int count, Pixel first = {}) {
    for (int i = 0; i < count; ++i) pixels.push_back({first.x + i, first.y});
    x.resize(static_cast<std::size_t>(count) * static_cast<std::size_t>(pattern.n()));
    y.resize(x.size());
    pattern.fill(pixels, {x, y});
  }
};

inline Pattern pattern_of(const std::string& text, int n) {
  return Pattern(PatternChoice(parse_spec(text, "bench")), n, Draw{1, 0});
}

}  // namespace moire::bench
