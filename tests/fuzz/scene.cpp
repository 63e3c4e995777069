// Scene files: read, and the scene that comes out halved into active pixels and computed at a few of them.
#include <cmath>

#include "engine/active_rows.h"
#include "engine/exact.h"
#include "fuzz.h"
#include "study/scene_file.h"

using namespace moire;

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size > 4096) return 0;
  return fuzz::run_target([&] {
    const NamedScene scene = parse_scene(fuzz::text_of(data, size), "s.toml", "s");
    static const Filter kBox(parse_spec("box", "")), kTent(parse_spec("tent", ""));
    const Grid grid = scene.image.grid();
    if (std::int64_t{grid.width} * grid.height > 4096) return;
    fuzz::require(enumerate(scene.image, 0.5).active_pixels() <= std::int64_t{grid.width} * grid.height,
                  "no more pixels are active than there are");
    for (const Filter* filter : {&kBox, &kTent}) {
      for (const Pixel pixel : {Pixel{0, 0}, Pixel{grid.width / 2, grid.height / 2}}) {
        const Exact exact = exact_pixel(scene.image, *filter, pixel);
        // NaN fails as well.
        fuzz::require(exact.bound >= 0 && exact.value >= -exact.bound && exact.value <= 1 + exact.bound,
                      "a coverage is in [0, 1] up to its bound");
      }
    }
  });
}
