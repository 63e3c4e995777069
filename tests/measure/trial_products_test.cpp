// Standard errors of structured fractions, against what many simulated experiments show; and the products they are made
// of, against direct sums.
#include "measure/trial_products.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <numeric>
#include <string>
#include <vector>

#include "measure/spectral_shares.h"
#include "noise_images.h"

namespace moire {
namespace {

constexpr int kSide = 16;

using Image = std::function<std::vector<double>(std::uint64_t seed, std::uint32_t trial)>;

// A few tones that a trial moves all together, by one random shift: whatever their number, a trial is two random
// numbers, as of a fixed set of points over the whole image with one random shift. Mean square 1/2.
std::vector<double> shifted_tones(std::uint64_t seed, std::uint32_t trial, int tones) {
  const Words w = hash(pixel_key(draw_hash(seed, trial), {0, 0}), 1, Axis::shift);
  const double right = unit(w.a, w.b), down = unit(w.c, w.d);
  return image_of(kSide, kSide, [&](int x, int y) {
    double sum = 0;
    for (int i = 1; i <= tones; ++i) {
      const int kx = i, ky = i % 3 - 1;
      sum += std::cos(kTau *
                      (kx * (x / static_cast<double>(kSide) + right) + ky * (y / static_cast<double>(kSide) + down)));
    }
    return sum / std::sqrt(tones);
  });
}

double structure(int x, int y) { return std::sin(kTau * (3 * x + 2 * y) / kSide); }  // mean square 1/2

struct Found {
  double by_chance = 0, by_error = 0;  // how often the truth was within two standard errors
  double scatter = 0;                  // root mean square of what the estimates are off
  double chance = 0, error = 0;        // of the standard errors
  double of_bins = 0;                  // of what independent pixels would have
};

// `truth`: the fraction of structure without end of trials.
Found experiments(int count, int trials, double truth, const Image& image) {
  Found found;
  for (int e = 0; e < count; ++e) {
    Spectra s = spectra_of(kSide, kSide, SpectrumWindow::none, trials,
                           [&](std::uint32_t t) { return image(static_cast<std::uint64_t>(e), t); });
    const StructuredFraction f = structured_fraction(s);
    const double off = f.fraction - truth;
    s.products = {};
    const StructuredFraction of_bins = structured_fraction(s);
    CHECK(of_bins.error == of_bins.chance);
    found.by_chance += std::fabs(off) <= 2 * f.chance ? 1.0 / count : 0.0;
    found.by_error += std::fabs(off) <= 2 * f.error ? 1.0 / count : 0.0;
    found.chance += f.chance * f.chance / count;
    found.error += f.error * f.error / count;
    found.of_bins += of_bins.chance * of_bins.chance / count;
    found.scatter += off * off / count;
  }
  for (double* square : {&found.scatter, &found.chance, &found.error, &found.of_bins}) *square = std::sqrt(*square);
  return found;
}

// Experiments in which a share p holds: the smallest share that is not a surprise, four standard deviations below.
double least(double p, int count) { return p - 4 * std::sqrt(p * (1 - p) / count); }

// Of 8 trials the standard error is known to 1/4, and two of it are Student's 91% of 7 degrees of freedom.
double share_of(int trials) { return trials == 8 ? 0.914 : 0.95; }

// Products of groups as their definition has them, with a large mean of its own in each group.
TrialProducts products_of(int groups, std::uint64_t seed) {
  TrialGroups trials;
  for (int t = 0; t < groups; ++t) {
    std::vector<double> image = white_noise(5, 3, seed, static_cast<std::uint32_t>(t));
    for (std::size_t i = 0; i < image.size(); ++i) image[i] += 3.0 + static_cast<double>(i);
    trials.add(image, {});
  }
  return trials.finish(0.5);
}

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("products are sums over pixels less what is left out, of groups of two when trials are too many") {
    const auto image = [](int t) { return white_noise(7, 5, 1, static_cast<std::uint32_t>(t)); };
    const auto left_out = [](int t) { return white_noise(3, 1, 2, static_cast<std::uint32_t>(t)); };
    for (const int trials : {1, 2, 31, 32, 33, 64, 65, 200}) {
      TrialGroups collected;
      for (int t = 0; t < trials; ++t) collected.add(image(t), left_out(t));
      const TrialProducts got = collected.finish(0.25);
      CAPTURE(trials);
      int size = 1;
      while (trials > TrialGroups::kMostGroups * size) size *= 2;
      REQUIRE(got.group_trials == size);
      REQUIRE(got.groups == trials / size);
      const auto mean_of = [&](int group, const auto& values) {
        std::vector<double> sum;
        for (int t = group * size; t < (group + 1) * size; ++t) {
          const std::vector<double> one = values(t);
          sum.resize(one.size());
          for (std::size_t i = 0; i < one.size(); ++i) sum[i] += one[i] / size;
        }
        return sum;
      };
      const auto dot = [](const std::vector<double>& a, const std::vector<double>& b) {
        return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
      };
      const auto n = static_cast<std::size_t>(got.groups);
      for (int a = 0; a < got.groups; ++a) {
        double power = 0;
        for (int t = a * size; t < (a + 1) * size; ++t)
          power += 0.25 * (dot(image(t), image(t)) - dot(left_out(t), left_out(t))) / size;
        CHECK(std::fabs(got.power[static_cast<std::size_t>(a)] - power) < 1e-13 * 35);  // a few roundings of 35 sums
        for (int b = 0; b < got.groups; ++b) {
          const double want =
              0.25 * (dot(mean_of(a, image), mean_of(b, image)) - dot(mean_of(a, left_out), mean_of(b, left_out)));
          // Single precision: 6e-8 of each of 35 products of about 1, and as much for each time groups were joined.
          CHECK(std::fabs(got.products[static_cast<std::size_t>(a) * n + static_cast<std::size_t>(b)] - want) < 1e-5);
        }
      }
    }
  }

  TEST_CASE("the squared covariance and the linear variance are means over different trials, as their formulas say") {
    for (const int groups : {4, 5, 9}) {
      TrialProducts p = products_of(groups, 3);
      p.group_trials = 2;
      const auto n = static_cast<std::size_t>(groups);
      const double share = 0.3, unit = 7;
      double two = 0, three = 0, four = 0, linear_three = 0, linear_four = 0;
      double n2 = 0, n3 = 0, n4 = 0, mean = 0;
      const auto at = [&](std::size_t i, std::size_t j) { return p.products[i * n + j] / unit; };
      const auto bare = [&](std::size_t i, std::size_t j) {
        return at(i, j) - share * (p.power[i] + p.power[j]) / 2 / unit;
      };
      for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j < n; ++j) mean += i == j ? 0 : bare(i, j) / static_cast<double>(n * (n - 1));
      const auto kernel = [&](std::size_t i, std::size_t j) { return bare(i, j) - mean; };
      for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t j = 0; j < n; ++j) {
          if (i == j) continue;
          two += at(i, j) * at(i, j);
          ++n2;
          for (std::size_t k = 0; k < n; ++k) {
            if (k == i || k == j) continue;
            three += at(i, j) * at(j, k);
            linear_three += kernel(i, j) * kernel(j, k);
            ++n3;
            for (std::size_t l = 0; l < n; ++l) {
              if (l == i || l == j || l == k) continue;
              four += at(i, j) * at(k, l);
              linear_four += kernel(i, j) * kernel(k, l);
              ++n4;
            }
          }
        }
      }
      const double squared = 4 * (two / n2 - 2 * three / n3 + four / n4);
      const double linear = std::max(0.0, 4 * 2 * (linear_three / n3 - linear_four / n4) / 50);
      // The direct sums of up to 3,024 products of 70^2 cancel: 3,024 roundings of 5,000 x 1e-16.
      CHECK(std::fabs(p.squared_covariance(unit) - squared) < 2e-9);
      CHECK(std::fabs(p.linear_variance(share, 50, unit) - linear) < 2e-9);
    }
    CHECK(std::isnan(products_of(3, 3).squared_covariance(1)));
    CHECK(products_of(3, 3).linear_variance(0.5, 3, 1) == 0);
  }

  TEST_CASE("trials that are all zero, or become so, have products of zero") {
    TrialGroups trials;
    for (int t = 0; t < 5; ++t) trials.add(std::vector<double>(6, t == 3 ? 1.0 : 0.0), {});
    const TrialProducts p = trials.finish(1);
    for (std::size_t i = 0; i < 25; ++i) CHECK(p.products[i] == (i == 18 ? 6 : 0));
  }
}

TEST_SUITE("heavy") {
  TEST_CASE("without structure two standard errors hold the truth in 95% of experiments, however few random numbers") {
    struct Noise {
      std::string name;
      int tones;  // 0: white noise
      Image image;
    };
    const Noise noises[] = {
        {"white", 0, [](std::uint64_t seed, std::uint32_t t) { return white_noise(kSide, kSide, seed, t); }},
        {"a shifted tone", 1, [](std::uint64_t seed, std::uint32_t t) { return shifted_tones(seed, t, 1); }},
        {"five shifted tones", 5, [](std::uint64_t seed, std::uint32_t t) { return shifted_tones(seed, t, 5); }},
    };
    constexpr int kCount = 400;
    for (const Noise& noise : noises) {
      for (const int trials : {8, 32, 80}) {  // 80: groups of 4
        const Found found = experiments(kCount, trials, 0, noise.image);
        CAPTURE(noise.name);
        CAPTURE(trials);
        CHECK(found.by_chance > least(share_of(trials), kCount));
        CHECK(found.by_error >= found.by_chance);
        // With few random numbers the estimate is like a chi-square of 2 degrees, of kurtosis 9: the scatter of 400 is
        // known to sqrt(8 / 1600) = 7%.
        CHECK(std::fabs(found.chance / found.scatter - 1) < 4 * 0.07);
        // What was given before, as if the bins were independent, is up to 5 times too small.
        if (noise.tones > 0) CHECK(found.of_bins < 0.6 * found.scatter);
        MESSAGE(noise.name, ", ", trials, " trials: within two errors in ", found.by_chance, " (", found.by_error,
                "), scatter ", found.scatter, ", standard error ", found.chance, " (", found.error, ")");
      }
    }
  }

  TEST_CASE("with structure two standard errors hold the true fraction in 95% of experiments") {
    constexpr int kCount = 300;
    for (const double amplitude : {0.5, 2.0}) {
      for (const int tones : {0, 5}) {
        for (const int trials : {8, 32, 80}) {
          // White noise has 1/256 of its power at zero frequency, which is left out.
          const double noise_power = tones == 0 ? 1.0 - 1.0 / (kSide * kSide) : 0.5;
          const double power = amplitude * amplitude / 2, truth = power / (power + noise_power);
          const Found found = experiments(kCount, trials, truth, [&](std::uint64_t seed, std::uint32_t t) {
            std::vector<double> image = tones == 0 ? white_noise(kSide, kSide, seed, t) : shifted_tones(seed, t, tones);
            for (int y = 0; y < kSide; ++y)
              for (int x = 0; x < kSide; ++x)
                image[static_cast<std::size_t>(y * kSide + x)] += amplitude * structure(x, y);
            return image;
          });
          CAPTURE(amplitude);
          CAPTURE(tones);
          CAPTURE(trials);
          CHECK(found.by_error > least(share_of(trials), kCount));
          // Of 300 experiments the scatter is known to 4%. The part that is cut off at zero makes the error too large
          // where there are few numbers and little of that part: half as much again at most here.
          CHECK(found.error > (1 - 4 * 0.04) * found.scatter);
          CHECK(found.error < 1.5 * found.scatter);
        }
      }
    }
  }
}

}  // namespace moire
