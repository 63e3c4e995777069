// What theory expects the noise of a study's cases to be (measure/noise_theory.h), beside what was measured.
#pragma once

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "measure/noise_theory.h"
#include "study/study.h"

namespace moire {

// Largest image for which it is worked out, in pixels; and most work of a case, the product of cells, distances of
// pairs and lags of pixels: about 6 s of one core.
inline constexpr std::int64_t kMaxExpectedPixels = std::int64_t{1} << 16;
inline constexpr double kMaxExpectedWork = 8e9;

class ExpectedNoise {
 public:
  explicit ExpectedNoise(const Study& study) : study_(study) {}

  // Expected noise power, bin by bin as Spectra::noise. Empty where theory has no closed form or its price is too high:
  // for layout=pixel; estimators other than unnormalised (a ratio has no second moments in closed form); patterns other
  // than `random` and `jittered` with its full amount (the power of others would have to be measured from sets of
  // points, which takes longer than the images); scenes that move; window hann, which weighs the pixels of an image
  // whose noise is not the same everywhere; and above the limits.
  //
  // The scene is taken from 4 x 4 points in each of 8 x 8 cells of a pixel. The cells cost 0.3% of the mean power for
  // disks of 1/4 pixel (noise_theory.h), the points a few 10^-4 of it, both less for larger shapes. Time: 64 x 64
  // pixels take some 20 ms for `random`; for `jittered` at 1 point per pixel 0.1 s with a box and 0.6 s with lanczos, a
  // third of that at 4.
  std::vector<double> of(const Case& c);

 private:
  const FineCoverage& coverage(std::uint32_t scene, int apron);

  const Study& study_;
  std::optional<std::pair<std::uint32_t, int>> covered_;  // scene and apron that coverage_ is of
  FineCoverage coverage_;                                 // some 40 MB at most
};

}  // namespace moire
