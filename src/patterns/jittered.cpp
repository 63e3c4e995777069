// Jittered sampling: one random point in each cell of a grid. Its error falls as N^-3/4 at edges.
// R. L. Cook, "Stochastic sampling in computer graphics", ACM TOG 5(1), 1986.
#include "patterns/jittered_grid.h"
#include "patterns/pattern.h"

namespace moire {
namespace {

struct Jittered {
  JitteredGrid grid;
  std::uint64_t draw;

  Jittered(const Args& args, int n, Draw d)
      : grid(JitteredGrid::of_pixel(n, args.number("amount"))), draw(draw_hash(d.seed, d.trial)) {}

  void fill(std::span<const Pixel> run, Points out) const noexcept {
    double *x = out.x.data(), *y = out.y.data();
    const int n = grid.columns * grid.rows;
    for (const Pixel& pixel : run) {
      grid.fill(pixel_key(draw, pixel), x, y);
      x += n;
      y += n;
    }
  }

  static constexpr int kLeastForCells = JitteredGrid::kLeastForCells;
  CellGrid cells(Pixel) const noexcept { return grid.cells(); }
  CellPoints take_cells(Pixel pixel, std::span<const CellSpan> counted, std::span<const CellSpan> filled,
                        Points out) const noexcept {
    return grid.take_cells(pixel_key(draw, pixel), counted, filled, out);
  }

  static constexpr auto area_count = JitteredArea::count;
  static constexpr auto fill_area = JitteredArea::fill;
};

}  // namespace

extern const PatternInfo jittered_pattern;
constinit const PatternInfo jittered_pattern = describe<Jittered>(
    {.name = "jittered",
     .title = "One random point in each cell of a grid",
     .cite = "Cook 1986",
     .varies = [](const Args& args) { return args.number("amount") > 0 ? Varies::by_trial : Varies::never; },
     .counts = jittered_count,
     .params = kJitteredParams});

}  // namespace moire
