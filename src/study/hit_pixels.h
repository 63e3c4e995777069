// The measure `edge-ratio`: the error of an image at an edge against the discrepancy of its samples.
//
// With a box filter of one pixel a pixel's error is the local discrepancy of its own samples for the half-plane that
// the edge cuts from it. Over lines of the invariant measure, restricted to those that hit the pixel, its mean square
// is the squared edge-l2 discrepancy of these samples (measure/discrepancy/edge_l2.h), whatever the pattern. So the
// ratio of the two means is 1, which ties the images of a study to the discrepancies of D. P. Mitchell, "Ray tracing
// and irregularities of distribution", 1992, section 5.
#pragma once

#include <cstdint>

#include "engine/samples.h"
#include "study/results.h"
#include "study/run.h"

namespace moire {

// Of the pixels that the edge hits and that have a sample.
struct HitPixels {
  std::int64_t count = 0;
  double mse = 0;                 // mean of squared error
  double discrepancy_square = 0;  // mean of edge-l2^2 of the pixels' own samples
};

// Whether the case's pixels are fractions of their own samples, and its scene a straight edge at rest.
bool has_edge_ratio(const Study& study, const Case& c);

// Precondition: has_edge_ratio(). `same_samples` says that all pixels have the same ones.
HitPixels hit_pixels(const Truth& truth, const CaseResult& result, Samples samples, bool same_samples);

// Sets hit_pixels, hit_mse and hit_edge_l2_sq.
void set_hit_pixels(Row& row, const HitPixels& hit);

}  // namespace moire
