// Random sampling: independent uniform points. Its error falls as N^-1/2 for every image; the yardstick of the others.
// R. L. Cook, "Stochastic sampling in computer graphics", ACM TOG 5(1), 1986, calls its spectrum white noise.
#include "patterns/area.h"
#include "patterns/pattern.h"
#include "patterns/uniform.h"

namespace moire {
namespace {

struct Random {
  static constexpr bool kHasTime = true;
  int n;
  std::uint64_t draw;

  Random(const Args&, int count, Draw d) : n(count), draw(draw_hash(d.seed, d.trial)) {}

  void fill(std::span<const Pixel> run, Points out) const noexcept {
    const auto count = static_cast<std::size_t>(n);
    for (std::size_t p = 0; p < run.size(); ++p) {
      const Points here = out.part(p * count, count);
      const Key key = pixel_key(draw, run[p]);
      uniform_points(key, Axis::xy, 0, n, here.x.data(), here.y.data());
      uniform_times(key, Axis::time, here.t);
    }
  }

  static constexpr auto area_count = any_area_count;
  static void fill_area(const Args&, Grid area, Draw d, Points out) {
    const Key key = pixel_key(draw_hash(d.seed, d.trial), {});
    uniform_points(key, Axis::area, 0, static_cast<int>(out.x.size()), out.x.data(), out.y.data());
    stretch(area, out);
    uniform_times(key, Axis::area_time, out.t);
  }
};

}  // namespace

extern const PatternInfo random_pattern;
constinit const PatternInfo random_pattern = describe<Random>({.name = "random",
                                                               .title = "Independent uniform points",
                                                               .cite = "Cook 1986",
                                                               .varies = [](const Args&) { return Varies::by_trial; },
                                                               .counts = any_count,
                                                               .params = {}});

}  // namespace moire
