// How visible an error is: its root mean square weighted with the eye's contrast sensitivity. J. L. Mannos and
// D. J. Sakrison, "The effects of a visual fidelity criterion on the encoding of images", IEEE Transactions on
// Information Theory 20(4), 1974.
#pragma once

#include "measure/spectrum.h"

namespace moire {

// The eye sees this many pixels per degree of its field: on a display with pixels of 0.31 mm (27 inches, 1920 x 1080)
// from 57 cm away. Half as many is half as far. Nyquist is then at 16 cycles per degree.
inline constexpr double kPixelsPerDegree = 32;

// A(f) = 2.6 (0.0192 + 0.114 f) exp(-(0.114 f)^1.1) over its largest value, 0.9809 at f = 7.9 cycles per degree; f >=
// 0. It was fitted with linear luminance errors passed through a cube root; here it weighs coverage as it is. The same
// in all directions, though eyes see diagonals less well.
double contrast_sensitivity(double cycles_per_degree);

// sqrt(mean over the bins of total power x contrast_sensitivity(|f| pixels_per_degree)^2), in units of coverage: the
// RMS error if the eye saw all frequencies as well as its best one. The mean error counts with the formula's value at
// 0, 0.051: a shift of the whole image's brightness is hardly seen. (It has its own number, the bias.) So do all bins
// over which a window spreads it (Spectra::is_mean), so that a constant error weighs the same with and without window.
// `pixels_per_degree` > 0.
double csf_weighted_rms(const Spectra& spectra, double pixels_per_degree = kPixelsPerDegree);

}  // namespace moire
