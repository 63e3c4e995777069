// Contrast sensitivity: values of the published formula, and the weighting of spectra with it.
#include <doctest/doctest.h>

#include <cmath>
#include <vector>

#include "measure/contrast_sensitivity.h"
#include "noise_images.h"

namespace moire {
namespace {

// The largest value of A: where its derivative vanishes, (0.0192 + u) 1.1 u^0.1 = 1, u = 0.114 f = 0.89956426544208,
// A = 2.6 x 0.91876426544208 x exp(-0.88948909...); worked out to 30 digits.
constexpr double kPeakFrequency = 7.8909146091410891, kPeak = 0.98087787655726166;

TEST_SUITE("unit") {
  TEST_CASE("contrast sensitivity has the values of the formula and 1 at its peak") {
    struct Value {
      double f, a;  // cycles per degree; A(f) before normalisation, worked out to 30 digits
    };
    const Value values[] = {{0, 0.04992},
                            {1, 0.315959951979193883},
                            {4, 0.810527555384318518},
                            {8, 0.980779694777865656},
                            {16, 0.690751536772623785},
                            {32, 0.150004722814325762},
                            {60, 0.004475958233492076}};
    for (const Value& v : values) {
      CAPTURE(v.f);
      CHECK(relative(contrast_sensitivity(v.f), v.a / kPeak) <= 1e-14);  // pow and exp, a few ulps
    }
    CHECK(relative(contrast_sensitivity(kPeakFrequency), 1) <= 1e-15);
    for (double f = 0; f < 100; f += 0.01) CHECK(contrast_sensitivity(f) <= 1 + 1e-15);
  }

  TEST_CASE("a tone counts with the sensitivity at its frequency, in cycles per degree of the display") {
    const int n = 64;
    for (const int k : {1, 5, 16, 30}) {
      for (const double per_degree : {16.0, kPixelsPerDegree, 100.0}) {
        const Spectra s = spectra_of(n, n, SpectrumWindow::none, 1, [&](std::uint32_t) {
          return image_of(n, n, [&](int x, int) { return 0.2 * std::cos(kTau * k * x / n); });
        });
        const double want = 0.2 * std::sqrt(0.5) * contrast_sensitivity(static_cast<double>(k) / n * per_degree);
        CAPTURE(k);
        CAPTURE(per_degree);
        // The transform's error, below 1e-13 (dft.h), may stand in bins of more sensitivity: its square is nothing.
        CHECK(relative(csf_weighted_rms(s, per_degree), want) <= 1e-12);
      }
    }
  }

  TEST_CASE("a constant error counts with the formula's value at zero") {
    for (const SpectrumWindow window : {SpectrumWindow::none, SpectrumWindow::hann}) {
      const Spectra s = spectra_of(8, 8, window, 1, [](std::uint32_t) { return std::vector<double>(64, 0.5); });
      CHECK(relative(csf_weighted_rms(s), 0.5 * 0.04992 / kPeak) <= 1e-14);  // a few roundings
    }
  }

  TEST_CASE("the weighted error is never above the RMS error") {
    for (const double per_degree : {1.0, 32.0, 1000.0}) {
      const Spectra s = white_spectra(30, 17, SpectrumWindow::none, 4, 1);
      double mean = 0;
      for (const double p : s.total) mean += p / static_cast<double>(s.total.size());
      CHECK(csf_weighted_rms(s, per_degree) < std::sqrt(mean));
    }
  }
}

}  // namespace
}  // namespace moire
