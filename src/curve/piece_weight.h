// One smooth piece of a weight in one coordinate: of k for a separable weight k(x) k(y), or for a radial one k(r). What
// scenes may know of a filter.
#pragma once

#include <span>

namespace moire {

// A polynomial on [low, high], pixels from the window's centre (of k(r): low >= 0), as a Chebyshev series in t = -1 at low to 1 at high. At
// least one coefficient.
struct PieceWeight {
  double low, high;
  std::span<const double> series;
  double top;    // bound on |k|
  double error;  // bound on |series - k|
};

}  // namespace moire
