// The strongest structured peak and its test.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "measure/spectral_peak.h"
#include "noise_images.h"

namespace moire {
namespace {

constexpr SpectrumWindow kWindows[] = {SpectrumWindow::none, SpectrumWindow::hann};

double tone(int kx, int ky, int width, int height, int x, int y) {
  return std::cos(kTau * (static_cast<double>(kx * x) / width + static_cast<double>(ky * y) / height) + 0.4);
}

// How many of many experiments without structure find a significant peak.
template <class Image>
int false_alarms(int n, SpectrumWindow window, int trials, int experiments, double rate, const Image& image) {
  int alarms = 0;
  for (int e = 0; e < experiments; ++e) {
    const Spectra s =
        spectra_of(n, n, window, trials, [&](std::uint32_t t) { return image(static_cast<std::uint64_t>(e), t); });
    const std::optional<SpectralPeak> peak = strongest_peak(s, rate);
    REQUIRE(peak);
    REQUIRE(peak->significant);
    CHECK(*peak->significant == (peak->p_value <= rate));
    alarms += *peak->significant ? 1 : 0;
  }
  return alarms;
}

TEST_SUITE("unit") {
  TEST_CASE("a planted tone is found, at its frequency and direction, significant and as high as it is") {
    const int width = 64, height = 48, trials = 16;
    const std::pair<int, int> places[] = {{9, 0},  {0, 7},  {12, 9}, {-12, 9}, {20, -15},
                                          {-1, 2}, {32, 0}, {32, 5}, {3, 24}};
    for (const auto& pair : places) {
      const int kx = pair.first, ky = pair.second;
      CAPTURE(kx);
      CAPTURE(ky);
      const Spectra s = spectra_of(width, height, SpectrumWindow::none, trials, [&](std::uint32_t t) {
        return image_of(width, height, [&](int x, int y) {
          return 0.4 * tone(kx, ky, width, height, x, y) + 0.5 * gaussian(1, t, x, y);
        });
      });
      const std::optional<SpectralPeak> peak = strongest_peak(s);
      REQUIRE(peak);
      // In the half plane; Nyquist counts as +1/2.
      const bool turn = ky < 0 || (ky == 0 && kx < 0);
      double fx = static_cast<double>(turn ? -kx : kx) / width;
      const double fy = static_cast<double>(turn ? -ky : ky) / height;
      CHECK(peak->fx == fx);
      CHECK(peak->fy == fy);
      double direction = std::atan2(fy, fx) * 360 / kTau;
      CHECK(relative(peak->direction, direction) <= 1e-15);
      CHECK(s.is_first(peak->column, peak->row));
      REQUIRE(peak->significant);
      CHECK(*peak->significant);
      CHECK(peak->p_value < 1e-6);
      // A tone on Nyquist is its own conjugate: (A cos phase)^2 x pixels; the others A^2 / 4.
      const bool own = kx == 32 && ky == 0;
      const double want = 0.16 * (own ? std::pow(std::cos(0.4), 2) : 0.25) * width * height;
      // Cross term with the noise of the mean, 0.25 / 16 a bin: relative error 2 sqrt(0.25 / 16 / want), times 4.
      CHECK(relative(peak->power, want) <= 8 * std::sqrt(0.25 / 16 / want));
      // Over noise of power 0.25; the median of 72 or fewer means of 16 exponentials: within 8%, 4 times: 1.2 dB.
      CHECK(relative(peak->height_db, 10 * std::log10(want / 0.25)) <= 1.5 / 27);
    }
  }

  TEST_CASE("Hann's window leaves a tone where it is and does not take a mean error for one") {
    const int n = 64, trials = 16;
    const Spectra s = spectra_of(n, n, SpectrumWindow::hann, trials, [&](std::uint32_t t) {
      return image_of(n, n, [&](int x, int y) { return 3 + tone(10, 20, n, n, x, y) + 0.5 * gaussian(2, t, x, y); });
    });
    const std::optional<SpectralPeak> peak = strongest_peak(s);
    REQUIRE(peak);
    CHECK(peak->fx == 10.0 / n);
    CHECK(peak->fy == 20.0 / n);
    CHECK(*peak->significant);
    // The middle bin has 2/3 of the power per axis: (1/2)^2 / (3/8). Noise 0.25 of 16 trials: below 3%.
    CHECK(relative(peak->power, 4.0 / 9 / 4 * n * n) <= 0.03);
  }

  TEST_CASE("noise alone gives false alarms as often as stated") {
    const auto white = [](std::uint64_t seed, std::uint32_t t) { return white_noise(16, 16, seed, t); };
    for (const SpectrumWindow window : kWindows) {
      // 130 bins: 1 - (1 - 0.2 / 130)^130 = 18%, 72.5 of 400, standard deviation 7.7; Hann's bins are not independent,
      // so that Bonferroni's bound is not reached.
      const int often = false_alarms(16, window, 8, 400, 0.2, white);
      CHECK(often < 72.5 + 4 * 7.7);
      CHECK(often > (window == SpectrumWindow::none ? 72.5 - 4 * 7.7 : 20.0));
      // 1%: 4 expected; 13 or more with probability 3e-4.
      CHECK(false_alarms(16, window, 8, 400, 0.01, white) < 13);
    }
  }

  TEST_CASE("noise on one row or a line alone gives no more false alarms, though many bins are improper there") {
    // On one row every bin of the middle column has a spectrum of one real number.
    const auto row = [](std::uint64_t seed, std::uint32_t t) {
      return image_of(16, 16, [&](int x, int y) { return y == 5 ? gaussian(seed, t, x, y) : 0.0; });
    };
    const auto slanted = [](std::uint64_t seed, std::uint32_t t) {
      return image_of(16, 16,
                      [&](int x, int y) { return std::abs(2 * x - y - 9) < 2 ? gaussian(seed, t, x, y) : 0.0; });
    };
    // As above.
    CHECK(false_alarms(16, SpectrumWindow::none, 8, 400, 0.2, row) < 72.5 + 4 * 7.7);
    CHECK(false_alarms(16, SpectrumWindow::none, 8, 400, 0.01, row) < 13);
    CHECK(false_alarms(16, SpectrumWindow::none, 8, 400, 0.2, slanted) < 72.5 + 4 * 7.7);
    CHECK(false_alarms(16, SpectrumWindow::none, 8, 400, 0.01, slanted) < 13);
  }

  TEST_CASE("where one bin is searched false alarms come at the stated rate, with one degree of freedom as with two") {
    struct Case {
      int width, noisy;  // pixels of the image, and how many of them have noise
    };
    // Two pixels have Nyquist alone, a bin that is its own conjugate. Three pixels have one pair: the real and the
    // imaginary part are one number if one pixel is noisy, and two if all are.
    for (const Case& c : {Case{2, 2}, Case{3, 1}, Case{3, 3}}) {
      CAPTURE(c.width);
      CAPTURE(c.noisy);
      int alarms = 0;
      for (std::uint64_t e = 0; e < 4000; ++e) {
        const Spectra s = spectra_of(c.width, 1, SpectrumWindow::none, 12, [&](std::uint32_t t) {
          return image_of(c.width, 1, [&](int x, int y) { return x < c.noisy ? gaussian(e, t, x, y) : 0.0; });
        });
        alarms += *strongest_peak(s, 0.1)->significant ? 1 : 0;
      }
      // 400 expected, standard deviation 19. (Three pixels: their estimated variances differ, which is taken for
      // impropriety now and then; few alarms are lost.)
      CHECK(std::abs(alarms - 400) < 4 * 19);
    }
  }

  TEST_CASE("every bin outside the mean error's is searched, conjugate pairs once") {
    const std::pair<int, int> sizes[] = {{1, 2}, {2, 2}, {3, 1}, {5, 4}, {16, 16}, {9, 31}};
    for (const auto& pair : sizes) {
      const int width = pair.first, height = pair.second;
      CAPTURE(width);
      CAPTURE(height);
      const Spectra s = white_spectra(width, height, SpectrumWindow::none, 3, 3);
      std::set<double> distinct;  // white noise: no two pairs have the same power
      for (std::size_t i = 0; i < s.total.size(); ++i)
        if (i != s.index(width / 2, height / 2)) distinct.insert(s.total[i]);
      const std::optional<SpectralPeak> peak = strongest_peak(s);
      REQUIRE(peak);
      CHECK(peak->searched == static_cast<std::int64_t>(distinct.size()));
    }
  }

  TEST_CASE("without significance the peak is the bin of most structured power") {
    const Spectra s = white_spectra(20, 20, SpectrumWindow::none, 6, 4);
    double most = -1;
    for (std::size_t i = 0; i < s.total.size(); ++i)
      if (i != s.index(10, 10)) most = std::max(most, s.structured[i]);
    const std::optional<SpectralPeak> peak = strongest_peak(s, 1e-9);
    REQUIRE(peak);
    CHECK(!*peak->significant);
    CHECK(peak->power == most);
  }

  TEST_CASE("a pattern that does not vary: what stands out is significant, and one trial of another has no test") {
    ErrorSpectra spectra(16, 16, SpectrumWindow::none);
    spectra.add(image_of(16, 16, [](int x, int y) { return tone(3, 4, 16, 16, x, y) + 0.1 * gaussian(5, 0, x, y); }));
    const std::optional<SpectralPeak> fixed = strongest_peak(spectra.finish(false));
    const std::optional<SpectralPeak> unknown = strongest_peak(spectra.finish());
    REQUIRE(fixed);
    REQUIRE(unknown);
    CHECK(fixed->fx == 3.0 / 16);
    CHECK(*fixed->significant);
    CHECK(fixed->p_value < 1e-10);
    CHECK(unknown->fx == fixed->fx);
    CHECK(unknown->power == fixed->power);
    CHECK(!unknown->significant);
    CHECK(std::isnan(unknown->p_value));
  }

  TEST_CASE("one realisation of white noise, taken for a pattern that does not vary, seldom has a significant peak") {
    for (const SpectrumWindow window : kWindows) {
      int alarms = 0;
      constexpr int kExperiments = 400;
      double height = 0;
      for (int e = 0; e < kExperiments; ++e) {
        ErrorSpectra spectra(32, 32, window);
        spectra.add(image_of(32, 32, [&](int x, int y) { return gaussian(static_cast<std::uint64_t>(e), 7, x, y); }));
        const std::optional<SpectralPeak> peak = strongest_peak(spectra.finish(false), 0.05);
        REQUIRE(peak->significant);
        alarms += *peak->significant ? 1 : 0;
        height += peak->height_db / kExperiments;
      }
      // 5% of 400 and four standard deviations; bins around that are conjugates make it rarer.
      CHECK(alarms <= 20 + 4 * 4.4);
      // The largest of 511 exponential numbers over their median: 10 log10(log(511) / log(2)) and a little.
      CHECK(height == doctest::Approx(9.8).epsilon(0.1));
    }
  }

  TEST_CASE("no error at all has no significant peak") {
    for (const int trials : {1, 2}) {
      ErrorSpectra spectra(8, 8, SpectrumWindow::none);
      for (int t = 0; t < trials; ++t) spectra.add(std::vector<double>(64, 0.0));
      const std::optional<SpectralPeak> peak = strongest_peak(spectra.finish(false));
      REQUIRE(peak);
      CHECK(peak->power == 0);
      CHECK(!*peak->significant);
      CHECK(std::isnan(peak->height_db));
    }
  }

  TEST_CASE("images without other frequencies and errors that are not finite have no peak") {
    CHECK(!strongest_peak(white_spectra(1, 1, SpectrumWindow::none, 3, 6)));
    CHECK(!strongest_peak(white_spectra(3, 3, SpectrumWindow::hann, 3, 6)));
    CHECK(strongest_peak(white_spectra(2, 1, SpectrumWindow::hann, 3, 6)));
    CHECK(strongest_peak(white_spectra(1, 40, SpectrumWindow::hann, 3, 6)));
    std::vector<double> image = white_noise(8, 8, 7, 0);
    image[0] = std::numeric_limits<double>::infinity();
    CHECK(!strongest_peak(spectra_of(8, 8, SpectrumWindow::none, 2, [&](std::uint32_t) { return image; })));
  }
}

}  // namespace
}  // namespace moire
