// The discrete Fourier transform of real images, by OpenCV's cv::dft in double: the one door to OpenCV.
#pragma once

#include <complex>
#include <span>
#include <vector>

namespace moire {

// X(k, l) = sum over the pixels (i, j) of image(i, j) exp(-2 pi i (k i / width + l j / height)), not scaled, for
// k = 0 .. width / 2 and l = 0 .. height - 1: row-major, dft_columns(width) values a row. The other half is the
// conjugate, X(-k, -l) = conj X(k, l). `image` is row-major, width x height >= 1 x 1.
//
// Error of a value: below 4e-16 (width + height) times the sum of |image|. (cv::dft makes its twiddle factors by a
// recurrence, so that they err by up to some 2 n 2^-53 on a side n, and adds what belongs to a prime factor of n term
// by term.) Where no value stands out, as in noise, also below 4e-16 (width + height) times the root of the sum of
// image^2, the RMS of the values: so measured for sides to 4096, 3e-15 at 128, 3e-14 at 512. A constant image of 1 x
// 4093, whose sum is 64 such roots, errs by twice that. A prime side n takes n^2 operations a line. The same bits for
// any number of threads; may be called from several at once.
std::vector<std::complex<double>> real_dft(std::span<const double> image, int width, int height);

constexpr int dft_columns(int width) noexcept { return width / 2 + 1; }

}  // namespace moire
