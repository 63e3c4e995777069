// Statistics over trials: closed forms, identities and the coverage of the intervals.
#include "measure/statistics.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <random>

namespace moire {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

// MSE of synthetic trials: image errors of a rate n^(2 slope), each trial off by a factor that all counts share and by
// one of its own, as sample counts that share hashes are.
std::vector<SlopePoint> synthetic(double slope, int trials, std::mt19937_64& random) {
  std::normal_distribution<double> normal(0, 1);
  std::vector<SlopePoint> points;
  for (const double n : {1.0, 4.0, 16.0, 64.0, 256.0}) points.push_back({n, {}});
  for (int t = 0; t < trials; ++t) {
    const double shared = 0.1 * normal(random);
    for (SlopePoint& p : points) {
      p.mse.push_back(0.25 * std::pow(p.n, 2 * slope) * std::exp(shared + 0.2 * normal(random)));
    }
  }
  return points;
}

// Standard deviations that the count of hits may lie below its mean: 4, so that a fixed seed fails by chance once in
// 30,000.
double lowest_count(int repeats, double coverage) {
  return repeats * coverage - 4 * std::sqrt(repeats * coverage * (1 - coverage));
}

TEST_SUITE("unit") {
  TEST_CASE("Student's quantile agrees with closed forms and with tables") {
    // Closed forms: dof 1 is tan(pi p / 2), dof 2 is sqrt(2 p^2 / (1 - p^2)), p = 0.95.
    CHECK(student_t95(1) == doctest::Approx(std::tan(0.475 * 3.14159265358979323846)).epsilon(1e-12));
    CHECK(student_t95(2) == doctest::Approx(std::sqrt(2 * 0.95 * 0.95 / (1 - 0.95 * 0.95))).epsilon(1e-12));
    // Printed to four digits in every table of t, two-sided 0.05.
    CHECK(std::fabs(student_t95(3) - 3.1824) < 5e-5);
    CHECK(std::fabs(student_t95(7) - 2.3646) < 5e-5);
    CHECK(std::fabs(student_t95(30) - 2.0423) < 5e-5);
    CHECK(std::fabs(student_t95(1000000000) - 1.9599639845) < 1e-8);
    // The two methods meet where one gives way to the other: neighbours differ by d t / d dof = g1 / dof^2.
    const double step = student_t95(499) - student_t95(500);
    CHECK(step == doctest::Approx(2.3722 / (499.5 * 499.5)).epsilon(0.01));
  }

  TEST_CASE("trials are averaged before the root") {
    const std::vector<double> mse{1, 9};
    CHECK(rms_over_trials(mse) == std::sqrt(5.0));
    CHECK(std::isnan(rms_over_trials({})));
  }

  TEST_CASE("one trial has no interval, equal trials have an interval of no width") {
    CHECK_FALSE(rms_interval(std::vector<double>{0.25}));
    CHECK_FALSE(rms_interval({}));
    CHECK_FALSE(rms_interval(std::vector<double>{0.25, kNan}));
    const auto equal = rms_interval(std::vector<double>{0.25, 0.25, 0.25});
    REQUIRE(equal);
    CHECK(equal->lo == 0.5);
    CHECK(equal->hi == 0.5);
    const auto zero = rms_interval(std::vector<double>{0, 0});
    REQUIRE(zero);
    CHECK(zero->lo == 0);
    CHECK(zero->hi == 0);
  }

  TEST_CASE("equal weights change no bit, and a weight counts as that many pixels") {
    const std::vector<double> mse = {0.3, 0.1, 0.25, 0.7};
    for (const double w : {1.0, 4.0}) {
      const std::vector<double> weights(mse.size(), w);
      CHECK(rms_over_trials(mse, weights) == rms_over_trials(mse));
      CHECK(rms_interval(mse, weights)->lo == rms_interval(mse)->lo);
      CHECK(rms_interval(mse, weights)->hi == rms_interval(mse)->hi);
    }
    // 3 pixels of 0.3, 1 of 0.1, none of 0.25, 2 of 0.7; a few roundings.
    const std::vector<double> weights = {3, 1, 0, 2};
    CHECK(rms_over_trials(mse, weights) == doctest::Approx(std::sqrt((0.9 + 0.1 + 1.4) / 6)).epsilon(1e-15));
  }

  TEST_CASE("the interval of a weighted RMSE covers the truth when weights and errors vary together") {
    // Lines with w pixels, each with an MSE of about 1 / w: the weighted mean is E[w mse] / E[w].
    constexpr int kRepeats = 2000;
    std::mt19937_64 random(3);
    std::uniform_real_distribution<double> uniform(1, 3);
    std::normal_distribution<double> normal(0, 1);
    const double truth = std::sqrt(std::exp(0.02) / 2);  // log-normal with sigma 0.2; E[w] = 2
    for (const std::size_t lines : {32, 128}) {
      int hits = 0;
      for (int i = 0; i < kRepeats; ++i) {
        std::vector<double> mse, weights;
        for (std::size_t k = 0; k < lines; ++k) {
          weights.push_back(uniform(random));
          mse.push_back(std::exp(0.2 * normal(random)) / weights.back());
        }
        const auto interval = rms_interval(mse, weights);
        hits += interval->lo <= truth && truth <= interval->hi;
      }
      CAPTURE(lines);
      CHECK(hits >= lowest_count(kRepeats, 0.94));
      CHECK(hits <= kRepeats * 0.97);  // nor is it far too wide
    }
  }

  TEST_CASE("the 95% interval of the RMSE covers the truth in 95% of experiments, from 4 trials on") {
    std::mt19937_64 random(11);
    std::normal_distribution<double> normal(0, 1);
    constexpr int kRepeats = 4000;
    for (const int trials : {4, 8, 32}) {
      CAPTURE(trials);
      int covered = 0;
      for (int i = 0; i < kRepeats; ++i) {
        // The MSE of an image of 200 independent pixels with normal errors of variance 1.
        std::vector<double> mse(static_cast<std::size_t>(trials), 0.0);
        for (double& m : mse) {
          std::gamma_distribution<double> chi_square(100, 2);
          m = chi_square(random) / 200;
        }
        const auto interval = rms_interval(mse);
        REQUIRE(interval);
        CHECK(interval->lo < interval->hi);
        covered += interval->lo <= 1 && 1 <= interval->hi;
      }
      CHECK(covered >= lowest_count(kRepeats, 0.95));
      CHECK(covered <= kRepeats - lowest_count(kRepeats, 0.05));
    }
  }

  TEST_CASE("a pure power law gives its exponent and an interval of no width") {
    for (const double slope : {-1.5, -0.75, -0.5, 0.0}) {
      std::vector<SlopePoint> points;
      for (const double n : {1.0, 4.0, 16.0, 64.0, 256.0}) {
        points.push_back({n, std::vector<double>(4, 0.3 * std::pow(n, 2 * slope))});
      }
      const auto fit = fit_slope(points);
      REQUIRE(fit);
      // Rounding of five logarithms of size below 10, over a spread of log n above 5.
      CHECK(std::fabs(fit->slope - slope) < 1e-14);
      CHECK(fit->points == 5);
      CHECK(fit->n_min == 1);
      CHECK(fit->n_max == 256);
      REQUIRE(fit->interval);
      CHECK(fit->interval->hi - fit->interval->lo < 1e-13);
    }
  }

  TEST_CASE("least squares agrees with the line through unequal points, worked by hand") {
    // log n = 0, 1, 3 and log RMSE = 0, -1, -2: slope = sum dx dy / sum dx^2 = -3 / (14/3).
    const std::vector<SlopePoint> points{
        {1.0, {1.0}}, {std::exp(1.0), {std::exp(-2.0)}}, {std::exp(3.0), {std::exp(-4.0)}}};
    const auto fit = fit_slope(points);
    REQUIRE(fit);
    CHECK(fit->slope == doctest::Approx(-9.0 / 14.0).epsilon(1e-14));
    CHECK_FALSE(fit->interval);
  }

  TEST_CASE("points without error are left out, and fewer than two different counts have no slope") {
    std::vector<SlopePoint> points{{1, {0.5, 0.5}}, {4, {0, 0}}, {16, {0.005, 0.005}}, {64, {kNan, 0.1}}};
    const auto fit = fit_slope(points);
    REQUIRE(fit);
    CHECK(fit->points == 2);
    CHECK(fit->n_max == 16);
    CHECK(fit->slope == doctest::Approx(0.5 * std::log(0.01) / std::log(16.0)).epsilon(1e-14));
    points.pop_back();
    points.pop_back();
    CHECK_FALSE(fit_slope(points));
    CHECK_FALSE(fit_slope({}));
    CHECK_FALSE(fit_slope(std::vector<SlopePoint>{{4, {0.5, 0.4}}, {4, {0.5, 0.3}}}));
  }

  TEST_CASE("a trial without error does not stop the resampling") {
    const std::vector<SlopePoint> points{{1, {0.5, 0.4, 0.6}}, {4, {0.1, 0, 0}}, {16, {0.02, 0.03, 0.01}}};
    const auto fit = fit_slope(points);
    REQUIRE(fit);
    REQUIRE(fit->interval);
    CHECK(std::isfinite(fit->interval->lo));
  }

  TEST_CASE("the same data give the same interval, bit for bit") {
    std::mt19937_64 random(5);
    const auto points = synthetic(-0.75, 6, random);
    const auto a = fit_slope(points), b = fit_slope(points);
    REQUIRE(a);
    REQUIRE(a->interval);
    CHECK(a->interval->lo == b->interval->lo);
    CHECK(a->interval->hi == b->interval->hi);
  }

  TEST_CASE("mse is bias^2 + variance, with the T denominator and with the T-1 one") {
    std::mt19937_64 random(7);
    std::normal_distribution<double> normal(0, 1);
    constexpr std::size_t kPixels = 500;
    for (const int trials : {1, 2, 3, 8, 50}) {
      CAPTURE(trials);
      TrialMoments moments(kPixels);
      std::vector<std::vector<double>> errors;
      for (int t = 0; t < trials; ++t) {
        std::vector<double> e(kPixels);
        for (std::size_t i = 0; i < kPixels; ++i) e[i] = 0.01 * static_cast<double>(i % 7) + 0.1 * normal(random);
        moments.add(e);
        errors.push_back(e);
      }
      // Two-pass brute force in long double.
      long double mse = 0, mean_squared = 0, population_variance = 0, bias_sq = 0, variance = 0;
      const long double n = trials;
      for (std::size_t i = 0; i < kPixels; ++i) {
        long double mean = 0, squared = 0, deviations = 0;
        for (const auto& e : errors) {
          mean += static_cast<long double>(e[i]) / n;
          squared += static_cast<long double>(e[i]) * static_cast<long double>(e[i]) / n;
        }
        for (const auto& e : errors) {
          deviations += (static_cast<long double>(e[i]) - mean) * (static_cast<long double>(e[i]) - mean);
        }
        mse += squared / kPixels;
        mean_squared += mean * mean / kPixels;
        population_variance += deviations / n / kPixels;
        bias_sq += (mean * mean - deviations / (n - 1) / n) / kPixels;
        variance += deviations / (n - 1) / kPixels;
      }
      const Split split = moments.split();
      CHECK(split.trials == trials);
      // Welford's update loses a few ulp per trial of the squared errors; 1e-14 is 45 ulp.
      const double tolerance = 1e-14 * static_cast<double>(mse);
      CHECK(std::fabs(split.mse - static_cast<double>(mse)) < tolerance);
      CHECK(std::fabs(static_cast<double>(mean_squared + population_variance - mse)) < tolerance);
      if (trials == 1) {
        CHECK(std::isnan(split.variance));
        CHECK(std::isnan(split.bias_sq));
        continue;
      }
      CHECK(std::fabs(split.variance - static_cast<double>(variance)) < tolerance);
      CHECK(std::fabs(split.bias_sq - static_cast<double>(bias_sq)) < tolerance);
      CHECK(std::fabs(split.bias_sq + split.variance - split.mse) < tolerance);
      // Exact pixels thin all three alike.
      const Split wide = moments.split(4 * kPixels);
      CHECK(wide.mse == split.mse / 4);
      CHECK(wide.variance == split.variance / 4);
    }
  }

  TEST_CASE("the bias of unbiased trials is estimated as zero on average, and so is negative about half the time") {
    std::mt19937_64 random(9);
    std::normal_distribution<double> normal(0, 1);
    int negative = 0;
    double sum = 0;
    constexpr int kRepeats = 400;
    constexpr std::size_t kPixels = 100;
    for (int r = 0; r < kRepeats; ++r) {
      TrialMoments moments(kPixels);
      for (int t = 0; t < 4; ++t) {
        std::vector<double> e(kPixels);
        for (double& x : e) x = normal(random);
        moments.add(e);
      }
      negative += moments.split().bias_sq < 0;
      sum += moments.split().bias_sq;
    }
    // Per pixel the estimate has variance 2 / (T (T-1)) = 1/6: the mean over all has deviation sqrt(1/6 / 40000); 4 of
    // them.
    CHECK(std::fabs(sum / kRepeats) < 4 * std::sqrt(1.0 / 6 / (kRepeats * kPixels)));
    CHECK(negative > 150);  // the median is slightly below 0; 4 deviations of a fair coin are 40
    CHECK(negative < 260);
  }

  TEST_CASE("a pixel that is NaN in one trial is left out of the split") {
    TrialMoments moments(3);
    moments.add(std::vector<double>{1, kNan, 3});
    moments.add(std::vector<double>{3, 0, 3});
    const Split split = moments.split();
    CHECK(split.variance == 1);  // (2 + 0) / 2
    CHECK(split.mse == 7);       // ((1 + 9) / 2 + 9) / 2
    CHECK(split.bias_sq == 6);   // ((4 - 1) + 9) / 2
    CHECK(std::isnan(TrialMoments(0).split().mse));
  }

  TEST_CASE("the 95% interval of a slope covers the truth in about 95% of experiments, from 4 trials on") {
    std::mt19937_64 random(13);
    constexpr int kRepeats = 1000;
    for (const int trials : {4, 8, 24}) {
      int covered = 0;
      for (int i = 0; i < kRepeats; ++i) {
        const auto fit = fit_slope(synthetic(-0.75, trials, random));
        REQUIRE(fit);
        REQUIRE(fit->interval);
        covered += fit->interval->lo <= -0.75 && -0.75 <= fit->interval->hi;
      }
      CAPTURE(trials);
      CAPTURE(covered);
      CHECK(covered >= lowest_count(kRepeats, 0.95));
      CHECK(covered <= kRepeats - lowest_count(kRepeats, 0.05));
    }
  }
}

}  // namespace
}  // namespace moire
