// The discrete Fourier transform against its definition in long double.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <thread>
#include <utility>
#include <vector>

#include "measure/dft.h"
#include "noise_images.h"

namespace moire {
namespace {

using Half = std::vector<std::complex<double>>;

using Root = std::complex<long double>;

// exp(-2 pi i k / n), k = 0 .. n - 1.
std::vector<Root> roots_of_unity(int n) {
  std::vector<Root> roots;
  for (int k = 0; k < n; ++k) roots.push_back(std::polar(1.0L, -2 * std::numbers::pi_v<long double> * k / n));
  return roots;
}

// The definition.
Half brute_dft(const std::vector<double>& image, int width, int height) {
  const std::vector<Root> root_x = roots_of_unity(width), root_y = roots_of_unity(height);
  // First along the rows, then along the columns.
  std::vector<Root> rows;
  for (int j = 0; j < height; ++j) {
    for (int k = 0; k < dft_columns(width); ++k) {
      Root sum = 0;
      for (int i = 0; i < width; ++i)
        sum += static_cast<long double>(image[static_cast<std::size_t>(j * width + i)]) *
               root_x[static_cast<std::size_t>(k * i % width)];
      rows.push_back(sum);
    }
  }
  Half out;
  for (int l = 0; l < height; ++l) {
    for (int k = 0; k < dft_columns(width); ++k) {
      Root sum = 0;
      for (int j = 0; j < height; ++j)
        sum += rows[static_cast<std::size_t>(j * dft_columns(width) + k)] *
               root_y[static_cast<std::size_t>(l * j % height)];
      out.emplace_back(static_cast<double>(sum.real()), static_cast<double>(sum.imag()));
    }
  }
  return out;
}

double norm_of(const std::vector<double>& image) {
  double sum = 0;
  for (const double v : image) sum += v * v;
  return std::sqrt(sum);
}

// The largest error of a value over the header's bound.
double error_of(const std::vector<double>& image, int width, int height) {
  const Half got = real_dft(image, width, height), want = brute_dft(image, width, height);
  REQUIRE(got.size() == want.size());
  double worst = 0;
  for (std::size_t i = 0; i < got.size(); ++i) worst = std::max(worst, std::abs(got[i] - want[i]));
  return worst / (4e-16 * (width + height) * norm_of(image));
}

TEST_SUITE("unit") {
  TEST_CASE("the transform is what its definition says, also for primes, odd sides and images of one line") {
    const std::pair<int, int> sizes[] = {{1, 1},  {2, 1},  {1, 2},   {2, 2},   {3, 1},   {1, 7},   {8, 1},
                                         {1, 16}, {5, 4},  {4, 5},   {13, 17}, {16, 16}, {31, 12}, {12, 31},
                                         {61, 2}, {2, 61}, {30, 27}, {128, 3}, {3, 128}, {127, 5}};
    for (const auto& pair : sizes) {
      const int width = pair.first, height = pair.second;
      CAPTURE(width);
      CAPTURE(height);
      CHECK(error_of(white_noise(width, height, 1, 0), width, height) < 1);
    }
  }

  TEST_CASE("long lines keep the stated accuracy") {
    for (const int n : {1021, 1024, 1000, 4096, 4093}) {
      CAPTURE(n);
      CHECK(error_of(white_noise(n, 1, 2, 0), n, 1) < 1);
      CHECK(error_of(white_noise(1, n, 3, 0), 1, n) < 1);
    }
  }

  TEST_CASE("several threads at once get the same bits as one") {
    const int width = 48, height = 37;
    std::vector<Half> want, got(4);
    for (std::uint32_t i = 0; i < 4; ++i) want.push_back(real_dft(white_noise(width, height, 5, i), width, height));
    for (int repeat = 0; repeat < 20; ++repeat) {
      std::vector<std::thread> threads;
      for (std::uint32_t i = 0; i < 4; ++i)
        threads.emplace_back([&got, i] { got[i] = real_dft(white_noise(width, height, 5, i), width, height); });
      for (std::thread& thread : threads) thread.join();
      for (std::size_t i = 0; i < 4; ++i) CHECK(got[i] == want[i]);
    }
  }
}

}  // namespace
}  // namespace moire
