// Mean power by distance from zero frequency: one definition of rings for the spectra of images and of point sets.
// R. A. Ulichney, "Dithering with blue noise", Proceedings of the IEEE 76(1), 1988.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace moire {

// The bins of one ring.
struct Ring {
  // Spectra of real data have P(-f) = P(f). The two bins of such a pair are one number, the square of a complex
  // Gaussian one, with two degrees of freedom; a bin that is its own partner (Nyquist) has one. So one realisation has
  // as many degrees of freedom as it has bins.
  std::int64_t bins = 0;
  std::int64_t distinct = 0;  // each pair once
  double mean = 0;            // of the power over the bins; NaN without bins
  // Ulichney's radial anisotropy in dB: 10 log10(s^2 / mean^2) with s^2 the unbiased variance of the power over the
  // distinct bins. A mean of M independent isotropic periodograms has about -10 log10(M); more than that: power depends
  // on direction. NaN for fewer than 2 distinct bins, where the mean is not positive, and for bins that are all alike
  // (s^2 <= kFlat mean^2), such as those of a single point.
  double anisotropy_db = 0;
};

// A relative variance as small as this, -200 dB, is rounding of transforms.
inline constexpr double kFlat = 1e-20;

// The ring of a frequency with components u and v in units of the width of rings: ring k is centred on distance k and
// holds k - 1/2 <= |(u, v)| < k + 1/2. Exact for integers below 2^22, which are never at a distance of k + 1/2.
int ring_of(double u, double v);

// Rings of a width x height array of power, row-major, zero frequency at column width / 2 and row height / 2 (integer
// division): bin (i, j) has the frequency ((i - width / 2) / width, (j - height / 2) / height) in cycles per step of
// the transformed data. Rings are 1 / max(width, height) wide, and element k is ring k. Zero frequency is left out:
// element 0 has no bins. Rings below max(width, height) / 2 of a square array are complete, the last one that is given
// here is that of the farthest corner. Bins whose entry of `left_out` is not 0 belong to no ring either; it is
// empty, or as long as `power`, and alike for conjugates. The same bits for any number of threads.
std::vector<Ring> rings(std::span<const double> power, int width, int height,
                        std::span<const std::uint8_t> left_out = {});

}  // namespace moire
