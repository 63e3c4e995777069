// The discrete Fourier transform of real images, by OpenCV's cv::dft in double.
#include "measure/dft.h"

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <cstdint>

#include <opencv2/core.hpp>

namespace moire {

std::vector<std::complex<double>> real_dft(std::span<const double> image, int width, int height) {
  assert(width > 0 && height > 0 && image.size() == static_cast<std::size_t>(std::int64_t{width} * height));
  // cv::dft of 4.6 runs in the thread that calls it. Should a later one split its work, it must not: once is enough.
  [[maybe_unused]] static const bool sequential = [] {
    cv::setNumThreads(1);
    return true;
  }();

  // cv::Mat has no view of const data; the input is not written.
  const cv::Mat in(height, width, CV_64FC1, const_cast<double*>(image.data()));
  cv::Mat full;
  cv::dft(in, full, cv::DFT_COMPLEX_OUTPUT);

  const int columns = dft_columns(width);
  std::vector<std::complex<double>> half;
  half.reserve(static_cast<std::size_t>(std::int64_t{columns} * height));
  for (int l = 0; l < height; ++l) {
    const auto* row = full.ptr<std::complex<double>>(l);  // cv's complex numbers are pairs of doubles, as std's are
    half.insert(half.end(), row, row + columns);
  }
  return half;
}

}  // namespace moire
