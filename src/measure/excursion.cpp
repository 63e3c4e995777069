// How far an image leaves [0, 1].
#include "measure/excursion.h"

#include <algorithm>
#include <cmath>

namespace moire {

void ExcursionTally::add(double value) noexcept {
  ++pixels_;
  if (!std::isfinite(value)) return;
  const double outside = std::max({0.0, value - 1, -value});
  if (outside == 0) return;
  (value > 0 ? found_.overshoot : found_.undershoot) =
      std::max(outside, value > 0 ? found_.overshoot : found_.undershoot);
  squares_.add(outside * outside);
}

Excursion ExcursionTally::finish() const {
  Excursion e = found_;
  if (pixels_ > 0) e.rms = std::sqrt(squares_.value() / static_cast<double>(pixels_));
  return e;
}

}  // namespace moire
