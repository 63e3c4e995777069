// Spectra of error images: units, and the split into structure and noise.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <thread>
#include <utility>
#include <vector>

#include "measure/spectrum.h"
#include "noise_images.h"

namespace moire {
namespace {

constexpr SpectrumWindow kWindows[] = {SpectrumWindow::none, SpectrumWindow::hann};
constexpr std::pair<int, int> kSizes[] = {{1, 1},   {1, 2},   {2, 1},  {3, 3},   {1, 16},  {17, 1}, {2, 31},
                                          {16, 16}, {15, 16}, {31, 8}, {61, 53}, {128, 3}, {100, 9}};

double mean_of(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

double mean_square(const std::vector<double>& values) {
  return std::inner_product(values.begin(), values.end(), values.begin(), 0.0) / static_cast<double>(values.size());
}

Spectra single(int width, int height, const std::vector<double>& image, SpectrumWindow window) {
  return spectra_of(width, height, window, 1, [&](std::uint32_t) { return image; });
}

TEST_SUITE("unit") {
  TEST_CASE("without a window the mean power is the mean squared error") {
    for (const auto& pair : kSizes) {
      const int width = pair.first, height = pair.second;
      CAPTURE(width);
      CAPTURE(height);
      const std::vector<double> image = white_noise(width, height, 1, 0);
      // Parseval; the transform's error is below 1e-13 of the RMS coefficient for such sizes (dft.h).
      CHECK(relative(mean_of(single(width, height, image, SpectrumWindow::none).total), mean_square(image)) <= 1e-12);
    }
  }

  TEST_CASE("with Hann's window the mean power is the windowed error's mean square over the window's") {
    for (const auto& pair : kSizes) {
      const int width = pair.first, height = pair.second;
      CAPTURE(width);
      CAPTURE(height);
      const std::vector<double> image = white_noise(width, height, 1, 0);
      const auto hann = [](int i, int n) {
        return n < 3 ? 1.0 : 0.5 - 0.5 * std::cos(kTau * (i + 0.5) / n);  // another form than the product's
      };
      const std::vector<double> window =
          image_of(width, height, [&](int x, int y) { return hann(x, width) * hann(y, height); });
      std::vector<double> windowed = image;
      for (std::size_t i = 0; i < image.size(); ++i) windowed[i] *= window[i];
      // As above.
      CHECK(relative(mean_of(single(width, height, image, SpectrumWindow::hann).total),
                     mean_square(windowed) / mean_square(window)) <= 1e-12);
    }
    for (const int n : {3, 4, 17, 64}) {  // the sum of sin^4 over equal steps is 3/8 n; 1e-14: n roundings
      CHECK(relative(mean_square(window_values(SpectrumWindow::hann, n)), 0.375) <= 1e-14);
    }
  }

  TEST_CASE("the total is the mean of the trials' periodograms, and structure and noise add up to it") {
    for (const SpectrumWindow window : kWindows) {
      for (const auto& pair : kSizes) {
        const int width = pair.first, height = pair.second;
        CAPTURE(width);
        CAPTURE(height);
        const int trials = 5;
        const auto image = [&](std::uint32_t t) {
          // Structure too, a little larger than the noise.
          return image_of(width, height, [&](int x, int y) { return std::sin(x + 2.0 * y) + gaussian(2, t, x, y); });
        };
        const Spectra s = spectra_of(width, height, window, trials, image);
        std::vector<double> mean(s.total.size(), 0.0);
        for (std::uint32_t t = 0; t < trials; ++t) {
          const Spectra one = single(width, height, image(t), window);
          CHECK(!one.has_split());
          for (std::size_t i = 0; i < mean.size(); ++i) mean[i] += one.total[i] / trials;
        }
        REQUIRE(s.structured.size() == s.total.size());
        REQUIRE(s.noise.size() == s.total.size());
        for (std::size_t i = 0; i < mean.size(); ++i) {
          // Rounding: some ten operations on numbers that are not much larger than the total.
          CHECK(relative(s.total[i], mean[i]) <= 1e-13);
          CHECK(relative(s.structured[i] + s.noise[i], s.total[i]) <= 1e-13);
          CHECK(s.noise[i] >= 0);
        }
      }
    }
  }

  TEST_CASE("conjugate bins have the same bits, and one of each pair is first") {
    for (const auto& pair : kSizes) {
      const int width = pair.first, height = pair.second;
      CAPTURE(width);
      CAPTURE(height);
      const Spectra s = white_spectra(width, height, SpectrumWindow::none, 3, 3);
      for (int row = 0; row < height; ++row) {
        for (int column = 0; column < width; ++column) {
          const int to = ((width / 2 - column) % width + width + width / 2) % width;
          const int down = ((height / 2 - row) % height + height + height / 2) % height;
          const std::size_t here = s.index(column, row), there = s.index(to, down);
          CHECK(s.total[here] == s.total[there]);
          CHECK(s.structured[here] == s.structured[there]);
          CHECK(s.noise[here] == s.noise[there]);
          CHECK(int{s.is_first(column, row)} + int{s.is_first(to, down)} == (here == there ? 2 : 1));
        }
      }
      CHECK(s.frequency_x(width / 2) == 0);
      CHECK(s.frequency_y(height / 2) == 0);
      CHECK(s.is_mean(width / 2, height / 2));
    }
  }

  TEST_CASE("a constant error is all at zero frequency, exactly") {
    for (const auto& pair : kSizes) {
      const int width = pair.first, height = pair.second;
      CAPTURE(width);
      CAPTURE(height);
      const double c = 0.3;
      const Spectra s =
          single(width, height, image_of(width, height, [&](int, int) { return c; }), SpectrumWindow::none);
      const double pixels = static_cast<double>(s.total.size());
      const bool powers_of_two = (width & (width - 1)) == 0 && (height & (height - 1)) == 0;
      for (std::size_t i = 0; i < s.total.size(); ++i) {
        if (i == s.index(width / 2, height / 2)) {
          CHECK(relative(s.total[i], c * c * pixels) <= 1e-14);  // a few roundings
        } else if (powers_of_two) {
          CHECK(s.total[i] == 0);
        } else {  // roots of unity that are no binary numbers: 1e-13 of the amplitude at most (dft.h), squared
          CHECK(s.total[i] <= 1e-26 * c * c * pixels);
        }
      }
    }
  }

  TEST_CASE("Hann's window spreads the mean error over the bins that is_mean names and no other") {
    for (const auto& pair : kSizes) {
      const int width = pair.first, height = pair.second;
      CAPTURE(width);
      CAPTURE(height);
      const Spectra s =
          single(width, height, image_of(width, height, [&](int, int) { return 1.0; }), SpectrumWindow::hann);
      const double pixels = static_cast<double>(s.total.size());
      for (int row = 0; row < height; ++row) {
        for (int column = 0; column < width; ++column) {
          // The window's spectrum is 1/2 at zero and 1/4 beside it, over sqrt(3/8), per axis: the weakest of the nine
          // bins has (1/16)^2 (8/3)^2 = 1/36 of the power without window.
          const double power = s.total[s.index(column, row)] / pixels;
          CHECK((s.is_mean(column, row) ? power > 0.027 : power < 1e-26));
        }
      }
    }
  }

  TEST_CASE("one wrong pixel has a flat spectrum, exactly so in the corner where all phases are 0") {
    for (const auto& pair : kSizes) {
      const int width = pair.first, height = pair.second;
      CAPTURE(width);
      CAPTURE(height);
      const double e = 0.7, flat = e * e / (width * height);
      const auto at = [&](int px, int py) {
        return single(width, height,
                      image_of(width, height, [&](int x, int y) { return x == px && y == py ? e : 0.0; }),
                      SpectrumWindow::none);
      };
      const Spectra corner = at(0, 0), elsewhere = at(width / 3, height - 1);
      for (std::size_t i = 0; i < corner.total.size(); ++i) {
        CHECK(corner.total[i] == corner.total[0]);
        CHECK(relative(corner.total[i], flat) <= 1e-15);
        CHECK(relative(elsewhere.total[i], flat) <= 1e-12);  // the transform's error, below 1e-13 (dft.h)
      }
    }
  }

  TEST_CASE("a tone that is the same in all trials is structure, of a quarter of its squared amplitude a pixel") {
    const int width = 48, height = 40, kx = 7, ky = -5, trials = 16;
    const double amplitude = 0.5;
    const Spectra s = spectra_of(width, height, SpectrumWindow::none, trials, [&](std::uint32_t t) {
      return image_of(width, height, [&](int x, int y) {
        return amplitude *
                   std::cos(kTau * (static_cast<double>(kx * x) / width + static_cast<double>(ky * y) / height) + 1) +
               gaussian(4, t, x, y);
      });
    });
    // A cos = A/2 (e^i + e^-i): two coefficients of A/2 times the number of pixels N, power A^2 / 4 N each.
    const double want = amplitude * amplitude / 4 * width * height;
    for (const int sign : {1, -1}) {
      const std::size_t i = s.index(width / 2 + sign * kx, height / 2 + sign * ky);
      // Noise of the mean, 1/T a bin, and the tone's amplitude: standard error of the power 2 sqrt(P 1/(2T)), times 4.
      CHECK(std::fabs(s.structured[i] - want) < 4 * 2 * std::sqrt(want / (2 * trials)));
      // The noise of a bin is 1 with a relative standard error of 1/sqrt(T - 1).
      CHECK(std::fabs(s.noise[i] - 1) < 4 / std::sqrt(trials - 1.0));
    }
    // All other bins: the largest of 960 exponential variables of mean 1/T exceeds 20/T with probability 2e-6.
    for (int row = 0; row < height; ++row) {
      for (int column = 0; column < width; ++column) {
        const int dx = column - width / 2, dy = row - height / 2;
        if ((dx == kx && dy == ky) || (dx == -kx && dy == -ky)) continue;
        CHECK(s.structured[s.index(column, row)] < 20.0 / trials);
      }
    }
  }

  TEST_CASE("the same tone with a random phase in each trial is noise, not structure") {
    const int width = 48, height = 40, kx = 7, ky = -5, trials = 64;
    const double amplitude = 0.5;
    const Spectra s = spectra_of(width, height, SpectrumWindow::none, trials, [&](std::uint32_t t) {
      const Words w = hash(pixel_key(draw_hash(5, t), {0, 0}), 0, Axis::shift);
      const double phase = kTau * unit(w.a, w.b);
      return image_of(width, height, [&](int x, int y) {
        return amplitude *
                   std::cos(kTau * (static_cast<double>(kx * x) / width + static_cast<double>(ky * y) / height) +
                            phase) +
               0.01 * gaussian(6, t, x, y);
      });
    });
    const double power = amplitude * amplitude / 4 * width * height;
    const std::size_t i = s.index(width / 2 + kx, height / 2 + ky);
    // The phases' mean is a random walk: |mean|^2 is power x exponential(1) / T, and what is left of it after the
    // correction has the standard deviation power / T. Less than 6 of these (e^-7) above zero; and noise makes up the
    // rest of the total.
    CHECK(std::fabs(s.structured[i]) < 6 * power / trials);
    CHECK(std::fabs(s.noise[i] - power) < 6 * power / trials);
    CHECK(relative(s.total[i], power) <= 0.01);  // cross terms with the noise: 2 0.01 / sqrt(64 power)
  }

  TEST_CASE("200 trials of noise have structured power 0 within its error") {
    for (const SpectrumWindow window : kWindows) {
      const int n = 64, trials = 200;
      const Spectra s = white_spectra(n, n, window, trials, 7);
      const double bins = n * n;
      // A bin's structured power has mean 0 and variance (1/T)^2 T/(T-1) of the noise's 1, twice for its own partner;
      // of n^2 bins half are other bins' conjugates, so the mean's variance is 2/n^2 of that; with Hann's window
      // neighbours correlate with 2/3 and 1/6 along an axis: (1 + 2 (4/9 + 1/36))^2 = (35/18)^2 times as much.
      const double correlated = window == SpectrumWindow::none ? 1.0 : 35.0 / 18;
      const double error = std::sqrt(2 / bins / (trials - 1.0) / trials) * correlated;
      CHECK(std::fabs(mean_of(s.structured)) < 4 * error);
      CHECK(std::any_of(s.structured.begin(), s.structured.end(), [](double p) { return p < 0; }));  // not clamped
      CHECK(std::fabs(mean_of(s.noise) - 1) < 4 * std::sqrt(2 / bins / (trials - 1.0)) * correlated);
    }
  }

  TEST_CASE("errors of any size: scaled by a power of two all power is, bit for bit") {
    const int width = 24, height = 15;
    for (const SpectrumWindow window : kWindows) {
      const Spectra one = white_spectra(width, height, window, 4, 8);
      for (const int exponent : {-450, -20, 450}) {
        const Spectra scaled = spectra_of(width, height, window, 4, [&](std::uint32_t t) {
          std::vector<double> image = white_noise(width, height, 8, t);
          for (double& v : image) v = std::ldexp(v, exponent);
          return image;
        });
        for (std::size_t i = 0; i < one.total.size(); ++i) {
          CHECK(scaled.total[i] == std::ldexp(one.total[i], 2 * exponent));
          CHECK(scaled.structured[i] == std::ldexp(one.structured[i], 2 * exponent));
          CHECK(scaled.noise[i] == std::ldexp(one.noise[i], 2 * exponent));
        }
      }
    }
  }

  TEST_CASE("noise a millionth of a millionth of the structure is measured beside it") {
    const int n = 32, trials = 100;
    const Spectra s = spectra_of(n, n, SpectrumWindow::none, trials, [&](std::uint32_t t) {
      return image_of(n, n, [&](int x, int y) { return std::cos(kTau * 5 * x / n) + 1e-12 * gaussian(9, t, x, y); });
    });
    // The tone's rounding errors are the same in each trial but for the last bits of its sum with the noise, 2^-54 =
    // 6e-17 a pixel: 4e-9 of the noise's power. What remains is chance: 2 / (bins (T - 1)), four times its root.
    CHECK(std::fabs(mean_of(s.noise) / 1e-24 - 1) < 4 * std::sqrt(2.0 / (n * n * (trials - 1.0))));
  }

  TEST_CASE("one trial has a total alone, unless the pattern does not vary: then all of it is structure") {
    const std::vector<double> image = white_noise(9, 8, 10, 0);
    ErrorSpectra spectra(9, 8, SpectrumWindow::none);
    spectra.add(image);
    CHECK(spectra.trials() == 1);
    const Spectra unknown = spectra.finish(), known = spectra.finish(false);
    CHECK(!unknown.has_split());
    CHECK(unknown.structured.empty());
    CHECK(known.has_split());
    CHECK(known.structured == known.total);
    CHECK(known.total == unknown.total);
    CHECK(std::all_of(known.noise.begin(), known.noise.end(), [](double p) { return p == 0; }));
  }

  TEST_CASE("trials that are all alike have no noise, exactly") {
    const std::vector<double> image = white_noise(12, 7, 11, 0);
    const Spectra s = spectra_of(12, 7, SpectrumWindow::hann, 9, [&](std::uint32_t) { return image; });
    CHECK(s.structured == s.total);
    CHECK(std::all_of(s.noise.begin(), s.noise.end(), [](double p) { return p == 0; }));
    CHECK(std::all_of(s.energy.begin(), s.energy.end(), [](double e) { return e == 0; }));
  }

  TEST_CASE("a pixel's energy is the variance of its error times the squared window") {
    const Spectra s = spectra_of(4, 3, SpectrumWindow::hann, 3, [&](std::uint32_t t) {
      return image_of(4, 3, [&](int x, int y) { return x == 1 && y == 1 ? static_cast<double>(t) : 0.25; });
    });
    const double wx = std::pow(std::sin(kTau / 2 * 1.5 / 4), 2), wy = 1;  // the second of four and of three pixels
    for (std::size_t i = 0; i < s.energy.size(); ++i) {
      // 0, 1, 2 have the variance 1; 1e-15: a few roundings.
      if (i == 5) CHECK(relative(s.energy[i], wx * wx * wy * wy) <= 1e-15);
      if (i != 5) CHECK(s.energy[i] == 0);
    }
  }

  TEST_CASE("an error that is not finite is in every number of the result") {
    std::vector<double> image = white_noise(8, 8, 12, 0);
    image[13] = std::numeric_limits<double>::quiet_NaN();
    const Spectra s = spectra_of(8, 8, SpectrumWindow::none, 2, [&](std::uint32_t) { return image; });
    CHECK(std::all_of(s.total.begin(), s.total.end(), [](double p) { return std::isnan(p); }));
  }

  TEST_CASE("spectra collected in several threads have the same bits as one after the other") {
    const Spectra want = white_spectra(33, 20, SpectrumWindow::hann, 6, 13);
    std::vector<Spectra> got(4);
    std::vector<std::thread> threads;
    for (Spectra& s : got) threads.emplace_back([&s] { s = white_spectra(33, 20, SpectrumWindow::hann, 6, 13); });
    for (std::thread& thread : threads) thread.join();
    for (const Spectra& s : got) {
      CHECK(s.total == want.total);
      CHECK(s.structured == want.structured);
      CHECK(s.noise == want.noise);
      CHECK(s.energy == want.energy);
    }
  }
}

}  // namespace
}  // namespace moire
