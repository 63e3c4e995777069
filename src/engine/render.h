// Sampled images: a pattern's samples in the cells that active windows touch, reconstructed by an estimator.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "engine/active_rows.h"
#include "filters/filter.h"
#include "patterns/pattern.h"
#include "testimages/testimage.h"

namespace moire {

// How samples become a pixel.
enum class Estimator : std::uint8_t { ratio };

// The estimators by name; throws Error naming the nearest ones.
std::span<const std::string_view> estimator_names();
Estimator find_estimator(std::string_view name, std::string_view place);

struct Rendered {
  // Default: one value per active pixel, row-major. Exhaustive: one value per pixel, row-major (dense = true).
  bool dense = false;
  std::vector<double> value;
  std::int64_t samples_total = 0;      // samples of the image grown by the filter's apron
  std::int64_t samples_evaluated = 0;  // point tests made
  std::int64_t fallbacks = 0;          // active pixels whose weight sum was too small
};

// `exhaustive` evaluates every sample of every pixel, without any skipping; the values of active pixels are the same
// bit for bit, and the others come out as exactly 0 or 1. `rows` must come from `scene` and filter.radius().
Rendered render(const TestImage& scene, const Pattern& pattern, const Filter& filter, Estimator estimator,
                const ActiveRows& rows, bool exhaustive = false);

}  // namespace moire
