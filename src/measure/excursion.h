// How far an image of something between 0 and 1 leaves [0, 1]: overshoot, undershoot and their energy, which negative
// lobes of a filter cause (ringing) and noisy weights too.
#pragma once

#include <cstdint>

#include "core/sum.h"

namespace moire {

struct Excursion {
  double overshoot = 0;   // largest value above 1, less 1; 0 where there is none
  double undershoot = 0;  // depth of the smallest value below 0
  double rms = 0;         // root of the mean over all pixels of the squared part outside [0, 1]
};

// Pixels in row-major order: the order of additions decides the last bit of rms. Values that are not finite count as
// pixels inside.
class ExcursionTally {
 public:
  void add(double value) noexcept;
  void add_flat(std::int64_t count) noexcept { pixels_ += count; }  // pixels that are exactly 0 or 1
  Excursion finish() const;

 private:
  Excursion found_;
  Sum squares_;
  std::int64_t pixels_ = 0;
};

}  // namespace moire
