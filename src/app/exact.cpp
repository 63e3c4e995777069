// moire exact: the exact image, or exact values of single pixels with their bounds.
#include "engine/exact.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <vector>

#include "app/commands.h"
#include "app/image_files.h"
#include "app/output.h"
#include "app/scene_argument.h"
#include "core/parallel.h"
#include "study/file_names.h"
#include "study/pixel_list.h"
#include "study/stopwatch.h"
#include "study/study.h"
#include "study/text_file.h"
#include "study/truth.h"

namespace moire {
namespace {

// What exact values cost and how good they are, beside the values themselves.
void say_cost(const std::string& place, std::int64_t count, const char* of, std::int64_t nanoseconds, double bound) {
  if (count == 0) return say(place, fmt::format("no {}", of));
  const double each = static_cast<double>(nanoseconds) / static_cast<double>(count);
  say(place, fmt::format("{} {}, {:.3g} us of wall time each on {} threads; bounds at most {:.2g}", count, of,
                         1e-3 * each, thread_count(), bound));
}

void print_pixels(const NamedScene& scene, const Filter& filter, const std::vector<Pixel>& pixels,
                  const std::string& place, const WeightAim& aim) {
  print("x,y,value,bound\n");
  std::int64_t nanoseconds = 0;
  double bound = 0;
  constexpr std::size_t kBlock = 1 << 14;  // pixels computed, then printed, at a time
  std::vector<Exact> values(kBlock);
  for (std::size_t begin = 0; begin < pixels.size(); begin += kBlock) {
    const std::size_t count = std::min(kBlock, pixels.size() - begin);
    const Stopwatch time;
    parallel_for(
        count, [&](std::size_t i) { values[i] = exact_pixel(scene.image, filter, pixels[begin + i], aim); }, 64);
    nanoseconds += time.nanoseconds();
    std::string lines;
    for (std::size_t i = 0; i < count; ++i) {
      const Pixel& p = pixels[begin + i];
      bound = std::max(bound, values[i].bound);
      fmt::format_to(std::back_inserter(lines), "{},{},{:.17g},{:.17g}\n", p.x, p.y, values[i].value, values[i].bound);
    }
    print(lines);
  }
  flush_output();
  say_cost(place, static_cast<std::int64_t>(pixels.size()), "pixels", nanoseconds, bound);
}

}  // namespace

Exit execute(const ExactOptions& options) {
  check_image_path("-o", options.out);
  Study study;
  study.scenes = {load_scene(options.scene)};
  study.filters = {Filter(parse_spec(options.filter, "--filter"))};
  if (!options.pixels.empty()) {
    print_pixels(study.scenes[0], study.filters[0],
                 parse_pixels(read_bytes(options.pixels, kMaxPixelListBytes), options.pixels), options.pixels,
                 options.aim);
    return Exit::ok;
  }
  check_image_size(study.scenes[0], "-o");
  Truth truth = find_truth(study.scenes[0].image, study.filters[0], options.aim);
  // The first time starts threads and makes tables, which shows where all is over at once.
  constexpr std::int64_t kShort = 20'000'000;  // nanoseconds
  if (truth.time_ns < kShort) truth = find_truth(study.scenes[0].image, study.filters[0], options.aim);
  write_exact_exr(options.out, study, 0, 0, truth);
  say_cost(options.out, truth.rows.active_pixels(), "active pixels", truth.time_ns, truth.exact.max_bound);
  return Exit::ok;
}

}  // namespace moire
