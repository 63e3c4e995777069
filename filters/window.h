// Windows: even functions on [-1, 1] that fall from the middle to the ends, to be multiplied with an endless kernel.
//
// Harris, "On the use of windows for harmonic analysis with the discrete Fourier transform", Proc. IEEE 66(1), 1978,
// but for Kaiser, "Nonrecursive digital filter design using the I0-sinh window function", Proc. IEEE Int. Symp.
// Circuits and Systems, 1974. Their scale is free: Parzen's is 2/3 in the middle.
#pragma once

#include <string_view>

#include "core/double_double.h"
#include "filters/ellipse.h"

namespace moire {

// The windows by name, as a choice parameter lists them.
inline constexpr std::string_view kWindowNames =
    "hann|hamming|blackman|kaiser|welch|bohman|cosine|blackman-harris|bartlett|parzen";

class Window {
 public:
  // `name` is one of kWindowNames; `beta`, in [0, 32], is Kaiser's: 0 no window at all, more a stronger one.
  Window(std::string_view name, double beta);

  // At |t| <= 1.
  Dd operator()(Dd t) const;
  // Bound on its absolute value over an ellipse in t whose foci have none of its breaks between them.
  double ellipse_bound(const Ellipse& e) const;
  // It is analytic but for 0 and, where this is true, +-1/2.
  bool breaks_halfway() const;

 private:
  struct Kind;
  static const Kind kKinds[];
  const Kind* kind_;
  double beta_;
};

}  // namespace moire
