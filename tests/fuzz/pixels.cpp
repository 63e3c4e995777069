// Lists of pixels: read, and the first of them computed in scenes of all kinds.
#include <algorithm>
#include <iterator>

#include "engine/exact.h"
#include "fuzz.h"
#include "study/pixel_list.h"
#include "study/scene_file.h"

using namespace moire;

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size > (1 << 14)) return 0;
  return fuzz::run_target([&] {
    const std::vector<Pixel> pixels = parse_pixels(fuzz::text_of(data, size), "pixels");
    const std::string grid = "width = 32\nheight = 24\n";
    static const NamedScene kScenes[] = {
        parse_scene(grid + "kind = \"edge\"\nthrough = [16.3, 12.1]\nnormal = 97.3", "", "edge"),
        parse_scene(grid + "kind = \"disk\"\ncenter = [15.7, 12.3]\nradius = 8.25", "", "disk"),
        parse_scene(grid + "kind = \"disks\"\ndisks = [[10.5, 20.25, 0.3], [20, 10, 3]]", "", "disks"),
        parse_scene(grid + "kind = \"checkerboard\"\n[camera]\nfocal = 32\nheight = 1.5\npitch = 20", "", "board"),
        parse_scene(grid + "kind = \"disk\"\ncenter = [15.7, 12.3]\nradius = 8.25\nmotion = [3, 1]", "", "moving")};
    static const Filter kFilters[] = {Filter(parse_spec("box", "")), Filter(parse_spec("mitchell", ""))};
    for (std::size_t i = 0; i < std::min<std::size_t>(pixels.size(), 4); ++i) {
      for (const NamedScene& scene : kScenes) {
        for (const Filter& filter : kFilters) {
          const Exact exact = exact_pixel(scene.image, filter, pixels[i]);
          fuzz::require(exact.bound >= 0 && exact.value > -1 && exact.value < 2, "an exact value is a number");
        }
      }
    }
  });
}
