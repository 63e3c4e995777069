// Regular sampling: the centres of an m x m grid of cells, the pattern whose aliasing all the others try to break up.
#include <cmath>

#include "patterns/instance.h"
#include "patterns/pattern.h"

namespace moire {
namespace {

PlainSet grid(int n) {
  const int m = static_cast<int>(std::lround(std::sqrt(n)));
  PlainSet set;
  set.x.reserve(static_cast<std::size_t>(n));
  set.y.reserve(static_cast<std::size_t>(n));
  for (int row = 0; row < m; ++row)
    for (int column = 0; column < m; ++column) {
      set.x.push_back((column + 0.5) / m);
      set.y.push_back((row + 0.5) / m);
    }
  return set;
}

struct Regular {
  Instances points;

  Regular(const Args& args, int n, Draw draw) : points(args, draw, grid(n), Instances::kWithCells) {}
  void fill(std::span<const Pixel> run, Points out) const noexcept { points.fill(run, out); }
  static constexpr int kLeastForCells = Instances::kLeastForCells;
  CellGrid cells(Pixel pixel) const noexcept { return points.cells(pixel); }
  CellPoints take_cells(Pixel pixel, std::span<const CellSpan> counted, std::span<const CellSpan> filled,
                        Points out) const noexcept {
    return points.take_cells(pixel, counted, filled, out);
  }
};

}  // namespace

extern const PatternInfo regular_pattern;
constinit const PatternInfo regular_pattern = describe<Regular>({.name = "regular",
                                                                 .title = "Centres of a square grid",
                                                                 .cite = "classical",
                                                                 .varies = instance_varies,
                                                                 .counts = square_count,
                                                                 .params = kInstanceParams});

}  // namespace moire
