// Sampled images: a pattern's samples in the cells that active windows touch, reconstructed by an estimator.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "engine/active_rows.h"
#include "engine/estimator.h"
#include "engine/samples.h"
#include "filters/filter.h"
#include "testimages/testimage.h"

namespace moire {

// Which pixels have a value of their own; the others are exactly 0 or 1, as their windows are.
enum class Pixels : std::uint8_t {
  active,   // ratio and control_variate: flat windows give exactly 0 or 1
  covered,  // unnormalised, and importance with negative lobes: also the pixels whose windows are all inside, where
            // the weights' sum shows
  every     // exhaustive
};

// Those that an estimator's image consists of; of importance estimators that of a filter without negative lobes.
constexpr Pixels rendered_pixels(Estimator estimator, bool exhaustive) {
  if (exhaustive) return Pixels::every;
  return estimator == Estimator::unnormalised ? Pixels::covered : Pixels::active;
}

struct Rendered {
  Pixels pixels = Pixels::active;
  std::vector<double> value;       // of these pixels, row-major
  std::int64_t samples_total = 0;  // samples of the image grown by the filter's apron; without it for importance
  // Point tests made of samples. What was counted without one is not among them (box_count.h), nor is a fallback's look
  // at the pixel's centre.
  std::int64_t samples_evaluated = 0;
  std::int64_t fallbacks = 0;  // active pixels whose weight sum was too small
};

// Whether pixels of a run of this cover have a value of their own.
constexpr bool is_rendered(Pixels pixels, Cover cover) {
  return pixels == Pixels::every || cover == Cover::partial || (pixels == Pixels::covered && cover == Cover::all);
}

// Calls f(x, y, cover, value) for every pixel with a value of its own, row-major.
template <class F>
void for_each_rendered(const ActiveRows& rows, const Rendered& rendered, F&& f) {
  std::size_t index = 0;
  for (int y = 0; y < rows.grid().height; ++y) {
    for (const Run& run : rows.row(y)) {
      if (!is_rendered(rendered.pixels, run.cover)) continue;
      for (std::int32_t x = run.x0; x < run.x1; ++x) f(x, y, run.cover, rendered.value[index++]);
    }
  }
}

// Refuses, naming the limit, what no machine here could count or hold: more than 2^53 samples in the image grown by the
// filter's apron, or more than 8 GiB of sums for the rows of cells that a window spans. Importance estimators have
// neither apron nor sums. `place` is for the message.
void require_renderable(Grid grid, const Filter& filter, Estimator estimator, std::int64_t spp, std::string_view place);

// `exhaustive` evaluates every sample of every pixel, without any skipping; the values of the pixels of the default
// path are the same bit for bit, and the others come out as exactly 0 or 1. `rows` must come from `scene` and
// filter.radius(), and require_renderable() and require_layout() must have passed; a set over the image must be of its
// size and the filter's apron. A moving scene is sampled at the times of the samples: then samples.has_time() must
// hold.
Rendered render(const TestImage& scene, Samples samples, const Filter& filter, Estimator estimator,
                const ActiveRows& rows, bool exhaustive = false);

}  // namespace moire
