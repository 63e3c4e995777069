// Jittered points, each at a random time of its own: Poisson-Time in D. P. Mitchell, "Ray tracing and irregularities of
// distribution", Third Eurographics Workshop on Rendering, 1992. x and y are those of `jittered` in the same draw.
#include "patterns/jittered_grid.h"
#include "patterns/pattern.h"
#include "patterns/uniform.h"

namespace moire {
namespace {

struct JitteredRandomTime {
  static constexpr bool kHasTime = true;
  JitteredGrid grid;
  std::uint64_t draw;

  JitteredRandomTime(const Args& args, int n, Draw d)
      : grid(JitteredGrid::of_pixel(n, args.number("amount"))), draw(draw_hash(d.seed, d.trial)) {}

  void fill(std::span<const Pixel> run, Points out) const noexcept {
    const auto n = static_cast<std::size_t>(grid.columns * grid.rows);
    for (std::size_t p = 0; p < run.size(); ++p) {
      const Points here = out.part(p * n, n);
      const Key key = pixel_key(draw, run[p]);
      grid.fill(key, here.x.data(), here.y.data());
      uniform_times(key, Axis::time, here.t);
    }
  }

  static constexpr int kLeastForCells = JitteredGrid::kLeastForCells;
  CellGrid cells(Pixel) const noexcept { return grid.cells(); }
  CellPoints take_cells(Pixel pixel, std::span<const CellSpan> counted, std::span<const CellSpan> filled,
                        Points out) const noexcept {
    return grid.take_cells(pixel_key(draw, pixel), counted, filled, out);
  }

  static constexpr auto area_count = JitteredArea::count;
  static void fill_area(const Args& args, Grid area, Draw d, Points out) {
    JitteredArea::fill(args, area, d, out);
    uniform_times(pixel_key(draw_hash(d.seed, d.trial), {}), Axis::area_time, out.t);
  }
};

}  // namespace

extern const PatternInfo jittered_random_time_pattern;
constinit const PatternInfo jittered_random_time_pattern = describe<JitteredRandomTime>(
    {.name = "jittered-random-time",
     .title = "One random point in each cell of a grid, at a random time",
     .cite = "Mitchell 1992",
     .varies = [](const Args& args) { return args.number("amount") > 0 ? Varies::by_trial : Varies::in_time; },
     .counts = jittered_count,
     .params = kJitteredParams});

}  // namespace moire
