// Estimators: how the samples of a pattern become pixels. A short list with parameters, written like filters.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "engine/samples.h"

namespace moire {

// Samples x_i have values f_i; k is the filter's weights, rho the samples per pixel. The first three share the samples
// of all pixels that a window touches. The importance estimators draw rho samples of their own for each pixel, with a
// density proportional to |k| (M. Pharr, W. Jakob and G. Humphreys, "Physically based rendering", 4th edition 2023,
// section 8.8), s the sign of k at a sample.
enum class Estimator : std::uint8_t {
  ratio,            // sum k f / sum k; the control variate where sum k < rho / 4. Exact on flat windows.
  unnormalised,     // sum k f / rho: unbiased and linear, so that spectral theory applies; noisy on flat windows
  control_variate,  // m + sum k (f - m) / rho, m the mean of the pixel's own samples in its window: exact where flat
  importance,       // A sum s f / rho, A the integral of |k| over the plane: unbiased and linear; exact on flat windows
                    // of filters without negative lobes, elsewhere noisy even there
  importance_ratio  // sum s f / sum s; the former where sum s = 0
};

// Names without parameters, by which messages call them.
std::span<const std::string_view> estimator_names();
// Every estimator with every form, as reports name them: "importance", "importance:form=ratio".
std::span<const std::string_view> estimator_texts();
std::string_view name_of(Estimator estimator);
// An estimator from NAME or NAME:key=value. Throws Error naming the nearest ones.
Estimator find_estimator(std::string_view text, std::string_view place);

// Whether each pixel has samples of its own, drawn after the filter.
constexpr bool is_importance(Estimator estimator) {
  return estimator == Estimator::importance || estimator == Estimator::importance_ratio;
}

// Throws Error for an importance estimator of one set over the image: such a set has no points for each pixel.
void require_layout(Estimator estimator, Layout layout, std::string_view place);

}  // namespace moire
