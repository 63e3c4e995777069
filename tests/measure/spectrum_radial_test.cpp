// Radial means of error spectra, their bands, and the numbers made of them.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

#include "measure/noise_envelope.h"
#include "measure/radial_spectrum.h"
#include "measure/spectral_shares.h"
#include "noise_images.h"

namespace moire {
namespace {

constexpr SpectrumWindow kWindows[] = {SpectrumWindow::none, SpectrumWindow::hann};

// Noise only within a pixel of a slanted line, as in the error of an edge.
std::vector<double> line_noise(int n, std::uint64_t seed, std::uint32_t trial) {
  return image_of(n, n, [&](int x, int y) {
    const double distance = std::fabs((x - n / 2.0) * 0.96 + (y - n / 2.0) * 0.28);
    return distance < 1 ? gaussian(seed, trial, x, y) : 0.0;
  });
}

// How often out of how many something held.
struct Rate {
  int held = 0, of = 0;
  void count(bool yes) {
    held += yes ? 1 : 0;
    ++of;
  }
  double value() const { return static_cast<double>(held) / of; }
};

// In how many of the rings of many experiments the band covers the true noise, `truth`, and in how many experiments the
// low-frequency ratio's interval covers 1.
template <class Image>
std::pair<Rate, Rate> coverage(int n, SpectrumWindow window, int trials, int experiments, double truth,
                               const Image& image) {
  Rate band, ratio;
  for (int e = 0; e < experiments; ++e) {
    const Spectra s =
        spectra_of(n, n, window, trials, [&](std::uint32_t t) { return image(static_cast<std::uint64_t>(e), t); });
    for (const RadialSpectrum& ring : radial_spectrum(s)) {
      if (ring.total.bins == 0) continue;
      REQUIRE(ring.noise_interval);
      band.count(ring.noise_interval->lo <= truth && truth <= ring.noise_interval->hi);
    }
    const LowFrequencyRatio low = low_frequency_ratio(s);
    REQUIRE(low.interval);
    CHECK(low.interval->lo <= low.ratio);
    CHECK(low.ratio <= low.interval->hi);
    ratio.count(low.interval->lo <= 1 && 1 <= low.interval->hi);
  }
  return {band, ratio};
}

TEST_SUITE("unit") {
  TEST_CASE("rings hold every bin but zero frequency once") {
    const std::pair<int, int> sizes[] = {{1, 2}, {2, 2}, {1, 16}, {16, 1}, {16, 16}, {31, 8}, {61, 53}, {2, 100}};
    for (const auto& pair : sizes) {
      const int width = pair.first, height = pair.second;
      CAPTURE(width);
      CAPTURE(height);
      const Spectra s = white_spectra(width, height, SpectrumWindow::none, 3, 1);
      const std::vector<RadialSpectrum> rings = radial_spectrum(s);
      std::int64_t bins = 0;
      double total = 0, structured = 0, noise = 0;
      for (const RadialSpectrum& ring : rings) {
        bins += ring.total.bins;
        if (ring.total.bins == 0) continue;
        const double n = static_cast<double>(ring.total.bins);
        total += ring.total.mean * n;
        structured += ring.structured * n;
        noise += ring.noise * n;
        // A chance of noise alone is never worth more than its bins.
        CHECK(ring.degrees <= 2 * n);
        CHECK(ring.frequency > 0);
      }
      CHECK(bins == std::int64_t{width} * height - 1);
      const std::size_t dc = s.index(width / 2, height / 2);
      double total_want = -s.total[dc], structured_want = -s.structured[dc], noise_want = -s.noise[dc];
      for (std::size_t i = 0; i < s.total.size(); ++i) {
        total_want += s.total[i];
        structured_want += s.structured[i];
        noise_want += s.noise[i];
      }
      // Sums of at most 3,000 numbers of either sign, of order 1 each.
      const double few = 1e-12 * static_cast<double>(s.total.size());
      CHECK(std::fabs(total - total_want) < few);
      CHECK(std::fabs(structured - structured_want) < few);
      CHECK(std::fabs(noise - noise_want) < few);
    }
  }

  TEST_CASE("the 95% band of a ring's noise covers the truth in 95% of many experiments, with either window") {
    for (const SpectrumWindow window : kWindows) {
      const auto [band, ratio] = coverage(
          24, window, 5, 200, 1.0, [](std::uint64_t seed, std::uint32_t t) { return white_noise(24, 24, seed, t); });
      // 200 x 17 rings: standard error 0.4% if all are independent; with Hann's window a ring and the next are not:
      // about 0.7%. Four of these.
      const double error = window == SpectrumWindow::none ? 0.004 : 0.007;
      CHECK(std::fabs(band.value() - 0.95) < 4 * error);
      // 200 intervals: standard error 1.5%.
      CHECK(std::fabs(ratio.value() - 0.95) < 4 * 0.0154);
    }
  }

  TEST_CASE("the band holds where noise is on a line only, and bins taken for independent would not") {
    const int n = 32, trials = 5;
    const double noisy = [&] {
      double count = 0;
      for (const double v : line_noise(n, 0, 0)) count += v != 0;
      return count;
    }();
    const auto image = [&](std::uint64_t seed, std::uint32_t t) { return line_noise(n, seed, t); };
    const auto [band, ratio] = coverage(n, SpectrumWindow::none, trials, 300, noisy / (n * n), image);
    // The rings of an experiment rise and fall together. If half of them were one and the same the standard error would
    // be that of 300 intervals, 1.3%; a sum of few unequal chi-squares in place of one, and variances estimated from 5
    // trials, may cost as much again.
    CHECK(std::fabs(band.value() - 0.95) < 0.04);
    CHECK(ratio.value() > 0.95 - 4 * 0.0126);  // too wide, as the header says
    // As many degrees as bins: the width of the band would be that of uniform noise.
    const Spectra s = spectra_of(n, n, SpectrumWindow::none, trials, [&](std::uint32_t t) { return image(0, t); });
    const RadialSpectrum middle = radial_spectrum(s)[static_cast<std::size_t>(n / 2 - 1)];
    CHECK(middle.degrees < 0.8 * static_cast<double>(middle.total.bins * (trials - 1)));
  }

  TEST_CASE("degrees of freedom: as many as bins for uniform noise, one where a single pixel is noisy") {
    const int n = 16, trials = 40;
    Spectra s = white_spectra(n, n, SpectrumWindow::none, trials, 2);
    std::vector<double> all(s.total.size(), 1.0);
    std::fill(s.energy.begin(), s.energy.end(), 3.0);
    // Constant energies estimated from T trials look as if they had been scattered a little less: what the correction
    // for scatter takes off, 2 / (T + 1), is then cut off at the number of bins.
    CHECK(relative(NoiseEnvelope(s).degrees(all), n * n) <= 1e-12);  // rounding
    std::fill(s.energy.begin(), s.energy.end(), 0.0);
    s.energy[37] = 5;
    CHECK(relative(NoiseEnvelope(s).degrees(all), 1) <= 1e-12);
    s.energy[38] = s.energy[100] = s.energy[200] = 5;
    const double corrected = 4 * 5 * (4 - 2 / (trials + 1.0)) / (5 * 4 * (1 - 2 / (trials + 1.0)));
    // All bins together: the square of the sum of energies over the sum of squares, each less its bias.
    CHECK(relative(NoiseEnvelope(s).degrees(all), corrected) <= 1e-12);
    std::fill(s.energy.begin(), s.energy.end(), 0.0);
    CHECK(NoiseEnvelope(s).degrees(all) == 0);
  }

  TEST_CASE("degrees of freedom of Hann's window, against a sum over all pairs of bins") {
    const int width = 12, height = 9;
    Spectra s = white_spectra(width, height, SpectrumWindow::hann, 3, 3);
    s.trials = std::numeric_limits<std::int64_t>::max();  // energies that are known, not estimated
    const std::vector<double> wx = window_values(s.window, width), wy = window_values(s.window, height);
    s.energy = image_of(width, height, [&](int x, int y) {
      return std::pow(wx[static_cast<std::size_t>(x)] * wy[static_cast<std::size_t>(y)], 2);
    });
    // Correlation of a bin with the one at distance d: 1, 2/3, 1/6, 0 ... per axis.
    const auto rho = [](int d, int n) {
      d = std::min(std::abs(d), n - std::abs(d));
      return d == 0 ? 1.0 : d == 1 ? 2.0 / 3 : d == 2 ? 1.0 / 6 : 0.0;
    };
    // Any weights that are equal at f and -f.
    const std::vector<double> weights = image_of(width, height, [&](int x, int y) {
      const int kx = x - width / 2, ky = y - height / 2;
      return kx * kx + 2 * ky * ky < 19 ? 1.0 + kx * kx : 0.25;
    });
    double sum = 0, pairs = 0;
    for (int a = 0; a < width * height; ++a) {
      sum += weights[static_cast<std::size_t>(a)];
      for (int b = 0; b < width * height; ++b) {
        const double r = rho(a % width - b % width, width) * rho(a / width - b / width, height);
        pairs += weights[static_cast<std::size_t>(a)] * weights[static_cast<std::size_t>(b)] * r * r;
      }
    }
    // Rounding of sums of 10^4 terms.
    CHECK(relative(NoiseEnvelope(s).degrees(weights), sum * sum / pairs) <= 1e-12);
  }

  TEST_CASE(
      "degrees of freedom of a set of bins are those of weights that are 1 there, whichever way they are summed") {
    const std::pair<int, int> sizes[] = {{16, 16}, {15, 8}, {9, 21}, {1, 32}, {2, 6}};
    for (const auto& pair : sizes) {
      const int width = pair.first, height = pair.second;
      for (const SpectrumWindow window : kWindows) {
        // Noise that is ten times stronger on one side.
        const Spectra s = spectra_of(width, height, window, 6, [&](std::uint32_t t) {
          return image_of(width, height,
                          [&](int x, int y) { return (x + y < height ? 10 : 1) * gaussian(11, t, x, y); });
        });
        const NoiseEnvelope envelope(s);
        for (std::uint32_t set = 0; set < 8; ++set) {
          // A random half of the bins; set 0 has all. A bin and its conjugate have the same power, and so the same lot.
          std::vector<std::size_t> bins;
          std::vector<double> weights(s.total.size(), 0.0);
          for (std::size_t i = 0; i < s.total.size(); ++i) {
            const double lot = std::sin(1e4 * s.total[i] * set);
            if (lot < 0) continue;
            bins.push_back(i);
            weights[i] = 1;
          }
          CAPTURE(width);
          CAPTURE(height);
          CAPTURE(set);
          // Rounding: one way goes through a transform, of an error below 1e-14 here (dft.h).
          CHECK(relative(envelope.degrees_of_set(bins), envelope.degrees(weights)) <= 1e-12);
        }
      }
    }
    const Spectra s = white_spectra(4, 4, SpectrumWindow::none, 3, 12);
    CHECK(NoiseEnvelope(s).degrees_of_set({}) == 0);
  }

  TEST_CASE("noise is improper where its bin is its own conjugate, or everywhere if one pixel makes it") {
    const int n = 16;
    Spectra s = white_spectra(n, n, SpectrumWindow::none, 500, 4);
    const NoiseEnvelope uniform(s);
    for (const int row : {0, 5, n / 2}) {
      for (const int column : {0, 3, n / 2}) {
        const bool own = (row == 0 || row == n / 2) && (column == 0 || column == n / 2);
        // Scatter of 256 variances estimated from 500 trials: sqrt(2 / 499) / 16 = 0.004 a coefficient, times 5.
        if (own) CHECK(uniform.impropriety(column, row) == 1);
        if (!own) CHECK(uniform.impropriety(column, row) < 0.02);
      }
    }
    std::fill(s.energy.begin(), s.energy.end(), 0.0);
    s.energy[77] = 2;
    CHECK(relative(NoiseEnvelope(s).impropriety(3, 5), 1) <= 1e-12);
  }

  TEST_CASE("white noise of T trials has the anisotropy of a mean of T periodograms") {
    for (const int trials : {2, 10, 40}) {
      const std::vector<RadialSpectrum> rings = radial_spectrum(white_spectra(64, 64, SpectrumWindow::none, trials, 5));
      CAPTURE(trials);
      for (const RadialSpectrum& ring : rings) {
        if (ring.total.distinct < 30) continue;
        // The estimate of a relative variance 1/T from m exponential-like numbers has a relative error of
        // sqrt(8 / m) at most (kurtosis of an exponential, 9; less for larger T), a tenth of 4.34 dB each; times 4.5.
        const double tolerance = 10 / std::log(10.0) * std::sqrt(8.0 / static_cast<double>(ring.total.distinct));
        CHECK(std::fabs(ring.total.anisotropy_db + 10 * std::log10(trials)) < 4.5 * tolerance);
      }
    }
  }

  TEST_CASE("structure in a ring stands out of the error that structured power has without it") {
    const int n = 64, trials = 50;
    const auto experiment = [&](double amplitude) {
      return radial_spectrum(spectra_of(n, n, SpectrumWindow::none, trials, [&](std::uint32_t t) {
        return image_of(n, n,
                        [&](int x, int y) { return amplitude * std::cos(kTau * 10 * x / n) + gaussian(6, t, x, y); });
      }));
    };
    for (const RadialSpectrum& ring : experiment(0)) CHECK(std::fabs(ring.structured) < 5 * ring.structured_error);
    // A^2 / 4 x 4096 in 2 of the ring's bins.
    const RadialSpectrum ring = experiment(0.2)[9];
    CHECK(relative(ring.structured, 0.04 / 4 * n * n * 2 / static_cast<double>(ring.total.bins)) <= 0.1);
    CHECK(ring.structured > 10 * ring.structured_error);
  }

  TEST_CASE("the low-frequency ratio of coloured noise is that of its spectrum") {
    // Differences of neighbours: power 2 - 2 cos(2 pi fx). Circular, so that bins stay independent.
    const int n = 64, trials = 20;
    const Spectra s = spectra_of(n, n, SpectrumWindow::none, trials, [&](std::uint32_t t) {
      return image_of(n, n, [&](int x, int y) { return gaussian(7, t, x, y) - gaussian(7, t, (x + 1) % n, y); });
    });
    double low = 0, low_bins = 0, all = 0, bins = 0;
    for (int row = 0; row < n; ++row) {
      for (int column = 0; column < n; ++column) {
        const double fx = s.frequency_x(column), fy = s.frequency_y(row), f = std::sqrt(fx * fx + fy * fy);
        if (f == 0) continue;
        const double power = 2 - 2 * std::cos(kTau * fx);
        all += power;
        ++bins;
        if (f >= 0.125) continue;
        low += power;
        ++low_bins;
      }
    }
    const LowFrequencyRatio ratio = low_frequency_ratio(s);
    const double want = low / low_bins / (all / bins);
    REQUIRE(ratio.interval);
    CHECK(ratio.ratio < 0.1);
    // The interval is one of 95%; twice its width covers but for 1 in 10^4.
    CHECK(std::fabs(ratio.ratio - want) < ratio.interval->hi - ratio.interval->lo);
  }

  TEST_CASE("the structured fraction is 0 for noise, 1 without it, and between that of the powers") {
    const int n = 48, trials = 30;
    const auto experiment = [&](double tone, double noise, double mean) {
      return structured_fraction(spectra_of(n, n, SpectrumWindow::none, trials, [&](std::uint32_t t) {
        return image_of(n, n, [&](int x, int y) {
          return mean + tone * std::cos(kTau * (11 * x + 4 * y) / n) + noise * gaussian(8, t, x, y);
        });
      }));
    };
    const StructuredFraction nothing = experiment(0, 1, 0), noiseless = experiment(1, 0, 0),
                             half = experiment(1, std::sqrt(0.5), 0), bias = experiment(0, 1, 2);
    CHECK(std::fabs(nothing.fraction) < 4 * nothing.error);
    CHECK(nothing.error < 0.01);
    CHECK(noiseless.fraction == 1);
    CHECK(noiseless.error == 0);
    // The tone has the mean square 1/2. Noise of 2304 x 30 pixels: 0.5% of half; cross terms are as small.
    CHECK(relative(half.fraction, 0.5) <= 0.03);
    CHECK(std::fabs(bias.fraction) < 4 * bias.error);
    CHECK(relative(bias.fraction_with_dc, 0.8) <= 0.02);  // 4 of 5
  }

  TEST_CASE("no number depends on the unit of the error: scaled by a power of two all are the same, bit for bit") {
    const int n = 20;
    const auto experiment = [&](int exponent) {
      return spectra_of(n, n, SpectrumWindow::hann, 4, [&](std::uint32_t t) {
        std::vector<double> image = line_noise(n, 13, t);
        for (double& v : image) v = std::ldexp(v, exponent);
        return image;
      });
    };
    const Spectra one = experiment(0);
    const std::vector<RadialSpectrum> rings = radial_spectrum(one);
    const LowFrequencyRatio low = low_frequency_ratio(one);
    const StructuredFraction fraction = structured_fraction(one);
    REQUIRE(low.interval);
    for (const int exponent : {-450, 450}) {  // 1e-135, 1e135
      CAPTURE(exponent);
      const Spectra s = experiment(exponent);
      const std::vector<RadialSpectrum> scaled = radial_spectrum(s);
      for (std::size_t k = 0; k < rings.size(); ++k) {
        CHECK(scaled[k].degrees == rings[k].degrees);
        if (rings[k].total.bins == 0) continue;
        CHECK(scaled[k].noise == std::ldexp(rings[k].noise, 2 * exponent));
        CHECK(scaled[k].structured_error == std::ldexp(rings[k].structured_error, 2 * exponent));
      }
      const LowFrequencyRatio scaled_low = low_frequency_ratio(s);
      CHECK(scaled_low.ratio == low.ratio);
      REQUIRE(scaled_low.interval);
      CHECK(scaled_low.interval->lo == low.interval->lo);
      CHECK(scaled_low.interval->hi == low.interval->hi);
      CHECK(structured_fraction(s).fraction == fraction.fraction);
      CHECK(structured_fraction(s).error == fraction.error);
      CHECK(structured_fraction(s).chance == fraction.chance);
    }
  }

  TEST_CASE("what is not known is not there: one trial, no noise, images too small") {
    const Spectra one = white_spectra(16, 16, SpectrumWindow::none, 1, 9);
    for (const RadialSpectrum& ring : radial_spectrum(one)) {
      CHECK(ring.total.mean > 0);
      CHECK(std::isnan(ring.structured));
      CHECK(std::isnan(ring.noise));
      CHECK(!ring.noise_interval);
      CHECK(ring.degrees == 0);
    }
    CHECK(std::isnan(low_frequency_ratio(one).ratio));
    CHECK(std::isnan(structured_fraction(one).fraction));

    ErrorSpectra spectra(16, 16, SpectrumWindow::none);
    spectra.add(white_noise(16, 16, 9, 0));
    const Spectra fixed = spectra.finish(false);
    for (const RadialSpectrum& ring : radial_spectrum(fixed)) {
      CHECK(ring.structured == ring.total.mean);
      CHECK(ring.noise == 0);
      CHECK(ring.structured_error == 0);
    }
    CHECK(std::isnan(low_frequency_ratio(fixed).ratio));
    CHECK(structured_fraction(fixed).fraction == 1);

    const std::pair<int, int> sizes[] = {{1, 1}, {2, 1}, {1, 3}, {2, 2}, {3, 3}, {1, 16}, {1, 32}};
    for (const SpectrumWindow window : kWindows) {
      for (const auto& pair : sizes) {
        const int width = pair.first, height = pair.second;
        CAPTURE(width);
        CAPTURE(height);
        const Spectra small = white_spectra(width, height, window, 3, 10);
        radial_spectrum(small);
        const LowFrequencyRatio ratio = low_frequency_ratio(small);
        // The only ones with a frequency below 1/8 beside zero, which with Hann has the bins at 1/16 or 1/32, too.
        const bool has_low = height == 32 || (height == 16 && window == SpectrumWindow::none);
        CHECK((ratio.ratio > 0) == has_low);
        CHECK((ratio.low > 0) == has_low);
        structured_fraction(small);
      }
    }
  }
}

}  // namespace
}  // namespace moire
