// Expected noise spectra against closed forms. Against rendered images: tests/study/noise_theory_test.cpp.
#include "measure/noise_theory.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <numbers>
#include <string>
#include <vector>

#include "core/parallel.h"
#include "filters/filter.h"
#include "measure/filter_metrics.h"

using namespace moire;

namespace {

constexpr int kPerPixel = 8;

Filter filter_of(const std::string& text) { return Filter(parse_spec(text, "test")); }

// A scene that is 1 everywhere.
FineCoverage full(Grid image, int apron) {
  const auto cells = [&](int pixels) { return static_cast<std::size_t>((pixels + 2 * apron) * kPerPixel); };
  return {image, apron, kPerPixel, std::vector<double>(cells(image.width) * cells(image.height), 1.0)};
}

// Calls check(power, f_x, f_y) for every bin.
template <class Check>
void for_each_bin(const std::vector<double>& power, Grid grid, const Check& check) {
  for (int row = 0; row < grid.height; ++row) {
    for (int column = 0; column < grid.width; ++column) {
      check(power[static_cast<std::size_t>(row * grid.width + column)],
            static_cast<double>(column - grid.width / 2) / grid.width,
            static_cast<double>(row - grid.height / 2) / grid.height);
    }
  }
}

double mean_of(const std::vector<double>& values) {
  double sum = 0;
  for (const double v : values) sum += v;
  return sum / static_cast<double>(values.size());
}

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("on a full field independent points have flat noise under a box, and none at zero frequency") {
    const Grid grid{12, 9};
    const auto power = expected_noise(filter_of("box").kernel(), full(grid, 0), 2.5, random_pairs(kPerPixel));
    // Sums of some 7,000 cells, each right to an ulp or so.
    for_each_bin(power, grid, [](double p, double fx, double fy) {
      CHECK(p == doctest::Approx(fx == 0 && fy == 0 ? 0 : 1 / 2.5).epsilon(1e-11));
    });
  }

  TEST_CASE("on a full field points jittered in cells of a pixel have the noise of cubic B-splines under a box") {
    // rho cov at a distance of d pixels is [d = 0] minus the integral of (1 - |u - d|) (1 - |u|): 2/3, 1/6 in each
    // axis.
    const Grid grid{12, 9};
    const auto power = expected_noise(filter_of("box").kernel(), full(grid, 0), 1, jittered_pairs(1, 1, kPerPixel));
    for_each_bin(power, grid, [](double p, double fx, double fy) {
      const auto spline = [](double f) { return 2.0 / 3 + std::cos(2 * std::numbers::pi * f) / 3; };
      // No error but rounding: the kernel is constant in a cell, and p is taken as its mean.
      CHECK(std::fabs(p - (1 - spline(fx) * spline(fy))) < 1e-11);
    });
  }

  TEST_CASE(
      "on a full field the mean noise power of independent points is the filter's noise gain over their density") {
    const Grid grid{10, 14};
    for (const std::string text : {"box", "tent", "mitchell", "gaussian", "lanczos", "bspline:order=5"}) {
      CAPTURE(text);
      const Filter filter = filter_of(text);
      const double area = (grid.width + 2.0 * filter.apron()) * (grid.height + 2.0 * filter.apron());
      // All exact values are 1.
      const double want = (filter_metrics(filter.kernel()).noise_gain - 1 / area) / 3;
      const auto power = expected_noise(filter.kernel(), full(grid, filter.apron()), 3, random_pairs(kPerPixel));
      // Gauss's rule of four nodes per eighth of a pixel is exact for cubics, and to 1e-10 for the others.
      CHECK(mean_of(power) == doctest::Approx(want).epsilon(1e-9));
    }
  }

  TEST_CASE("away from borders the noise of independent points is the filter's squared response, folded") {
    const Grid grid{64, 64};
    const Filter filter = filter_of("gaussian");
    const Kernel& kernel = filter.kernel();
    const auto power = expected_noise(kernel, full(grid, filter.apron()), 1, random_pairs(kPerPixel));
    const auto response = [&kernel](double f) {
      double sum = 0;  // midpoint rule: 3e-6 for this kernel, which goes to zero at its ends
      for (int i = 0; i < 3000; ++i) {
        const double x = -1.5 + (i + 0.5) * 1e-3;
        sum += 1e-3 * kernel.k(x) * std::cos(2 * std::numbers::pi * f * x);
      }
      return sum;
    };
    std::map<double, double> folded;
    for (int k = -32; k < 32; ++k) {
      double& sum = folded[k / 64.0];
      for (int m = -4; m <= 4; ++m) sum += std::pow(response(k / 64.0 + m), 2);
    }
    // Pixels at distance d have a covariance with (1 - d_x / 64) (1 - d_y / 64) of what the lattice without end has.
    // With covariances r_0, r_1, r_2 in an axis, all positive, that is less by (2 r_1 + 4 r_2) / 64 at most.
    const double zero = folded[0], nyquist = folded[-0.5], quarter = folded[0.25];
    const double r1 = (zero - nyquist) / 4, r2 = (zero + nyquist - 2 * quarter) / 8;
    const double loss = 2 * zero * (2 * r1 + 4 * r2) / 64;
    for_each_bin(power, grid, [&](double p, double fx, double fy) {
      if (fx != 0 || fy != 0) CHECK(std::fabs(p - folded[fx] * folded[fy]) < loss);
    });
  }

  TEST_CASE("expected noise has the same bits for any number of threads") {
    FineCoverage scene = full({16, 12}, 2);
    for (std::size_t i = 0; i < scene.value.size(); ++i) scene.value[i] = static_cast<double>(i % 7) / 6;
    const auto noise = [&](int threads) {
      const ThreadLimit limit(threads);
      return expected_noise(filter_of("mitchell").kernel(), scene, 1, jittered_pairs(1, 1, kPerPixel));
    };
    CHECK(noise(1) == noise(4));
  }

  TEST_CASE("the power of a jittered grid gives the pairs that its law gives") {
    const PairExcess law = jittered_pairs(1, 0.5, kPerPixel);
    const auto sinc = [](double x) { return x == 0 ? 1 : std::sin(std::numbers::pi * x) / (std::numbers::pi * x); };
    const PairExcess measured =
        pairs_of_power([&](double fx, double fy) { return 1 - std::pow(sinc(fx) * sinc(0.5 * fy), 2); }, 2, kPerPixel);
    CHECK(measured.zero_power == 0);
    CHECK(law.zero_power == 0);
    const auto at = [](const PairExcess& p, int i, int j) {
      if (std::max(std::abs(i), std::abs(j)) > p.reach) return 0.0;
      return p.value[static_cast<std::size_t>((j + p.reach) * (2 * p.reach + 1) + i + p.reach)];
    };
    // Beyond 4 cycles per pixel, which the power leaves out, (sinc(f / 2) sinc(f / 8))^2 has an integral of 0.6% of the
    // 2 that the law has at distance 0 along y, and along x a quarter of that.
    for (int j = -measured.reach; j <= measured.reach; ++j)
      for (int i = -measured.reach; i <= measured.reach; ++i)
        CHECK(std::fabs(at(measured, i, j) - at(law, i, j)) < 0.008 * 2);
    CHECK(at(law, 0, 0) == doctest::Approx(-2 * (1 - 1.0 / 24) * (1 - 1.0 / 12)));  // mean of |u| over a cell: h / 3
  }
}
