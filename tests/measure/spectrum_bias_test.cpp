// What a mean error does to the numbers of error spectra, with and without window: nothing but at zero frequency.
#include <doctest/doctest.h>

#include <cmath>
#include <cstddef>
#include <vector>

#include "measure/radial_spectrum.h"
#include "measure/spectral_shares.h"
#include "noise_images.h"

namespace moire {
namespace {

constexpr SpectrumWindow kWindows[] = {SpectrumWindow::none, SpectrumWindow::hann};

TEST_SUITE("unit") {
  TEST_CASE("a constant error is at zero frequency alone: rings, low frequencies and structure see none of it") {
    const int n = 32, trials = 8;
    for (const SpectrumWindow window : kWindows) {
      // The same in all trials, and one that differs from trial to trial.
      for (const bool varies : {false, true}) {
        const auto offset = [&](std::uint32_t t) { return 0.25 + (varies ? 0.5 * gaussian(3, t, 0, 0) : 0.0); };
        const Spectra flat = spectra_of(n, n, window, trials, [&](std::uint32_t t) {
          return std::vector<double>(static_cast<std::size_t>(n * n), offset(t));
        });
        double squares = 0;
        for (std::uint32_t t = 0; t < trials; ++t) squares += offset(t) * offset(t) / trials;
        // The transform's error is below 1e-13 of the amplitude (dft.h), squared.
        for (const RadialSpectrum& ring : radial_spectrum(flat)) {
          if (ring.total.bins > 0) CHECK(ring.total.mean <= 1e-26 * squares * n * n);
          CHECK((ring.total.bins == 0) == (window == SpectrumWindow::hann && ring.frequency < 1.5 / n));
        }
        // And beside noise that is the same in either it changes nothing but rounding.
        const auto noise = [&](bool shifted) {
          return spectra_of(n, n, window, trials, [&](std::uint32_t t) {
            return image_of(n, n, [&](int x, int y) { return gaussian(4, t, x, y) + (shifted ? 8 * offset(t) : 0.0); });
          });
        };
        const Spectra bare = noise(false), shifted = noise(true);
        CHECK(relative(low_frequency_ratio(shifted).ratio, low_frequency_ratio(bare).ratio) <= 1e-12);
        CHECK(relative(low_frequency_ratio(shifted).low, low_frequency_ratio(bare).low) <= 1e-12);
        CHECK(std::fabs(structured_fraction(shifted).fraction - structured_fraction(bare).fraction) <= 1e-12);
        // Products are made of numbers in single precision: 6e-8 of 4 and less, over a noise of 1.
        if (!varies) CHECK(relative(structured_fraction(shifted).chance, structured_fraction(bare).chance) <= 1e-6);
      }
    }
  }

  TEST_CASE("the low-frequency power is that of the bins below 1/8, with the interval of chi-square") {
    for (const SpectrumWindow window : kWindows) {
      const Spectra s = white_spectra(32, 24, window, 6, 20);
      double sum = 0, bins = 0;
      for (int row = 0; row < 24; ++row) {
        for (int column = 0; column < 32; ++column) {
          if (s.is_mean(column, row) || std::hypot(s.frequency_x(column), s.frequency_y(row)) >= 0.125) continue;
          sum += s.noise[s.index(column, row)];
          ++bins;
        }
      }
      const LowFrequencyRatio low = low_frequency_ratio(s);
      CHECK(relative(low.low, sum / bins) <= 1e-14);  // a few roundings
      REQUIRE(low.low_interval);
      CHECK(low.low_interval->lo < 1);  // at this seed; 95% of all
      CHECK(low.low_interval->hi > 1);
      CHECK(low.low_interval->lo < low.low);
    }
  }
}

}  // namespace
}  // namespace moire
