// Spectra of point sets: definition, accuracy, and the traps that tools for such spectra have fallen into.
#include "measure/point_spectrum.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "core/parallel.h"
#include "measure/outer_sums.h"
#include "patterns/variants.h"

using namespace moire;
using moire::test::PointSet;
using moire::test::set_of;

namespace {

using Quad = __float128;
constexpr Quad kTwoPi =
    static_cast<Quad>(0x1.921fb54442d18p+2) + static_cast<Quad>(0x1.1a62633145c07p-52);  // to 2^-105
constexpr double kError = 2e-14;                                                         // promised of |sum| / N

struct QuadWave {
  Quad cosine, sine;
};

// cos and sin of 2 pi turns by Taylor's series after reduction to [-1/2, 1/2] turns: 45 terms reach 3.2^45 / 45! <
// 1e-32. Independent of any library's sine.
QuadWave quad_wave(Quad turns) {
  turns -= static_cast<Quad>(static_cast<std::int64_t>(turns));
  if (2 * turns > 1) turns -= 1;
  if (2 * turns < -1) turns += 1;
  const Quad angle = kTwoPi * turns;
  QuadWave sum{0, 0};
  Quad term = 1;
  for (int k = 0; k < 48; ++k) {
    const Quad signed_term = k % 4 < 2 ? term : -term;
    (k % 2 == 0 ? sum.cosine : sum.sine) += signed_term;
    term *= angle / (k + 1);
  }
  return sum;
}

double brute_power(const PointSet& set, int m, int n) {
  Quad c = 0, s = 0;
  for (std::size_t j = 0; j < set.x.size(); ++j) {
    const QuadWave wave = quad_wave(m * static_cast<Quad>(set.x[j]) + n * static_cast<Quad>(set.y[j]));
    c += wave.cosine;
    s += wave.sine;
  }
  return static_cast<double>((c * c + s * s) / static_cast<Quad>(set.x.size()));
}

std::vector<double> power_of(const std::vector<PointSet>& sets, int frequencies) {
  PointSpectrum spectrum(frequencies);
  for (const PointSet& set : sets) spectrum.add(set.x, set.y);
  return spectrum.power();
}

double at(const std::vector<double>& power, int frequencies, int m, int n) {
  return power[static_cast<std::size_t>((n + frequencies / 2) * frequencies + m + frequencies / 2)];
}

std::vector<PointSet> draws(const std::string& pattern, int n, std::uint32_t trials) {
  std::vector<PointSet> sets;
  for (std::uint32_t t = 0; t < trials; ++t) sets.push_back(set_of(pattern, n, {5, t}));
  return sets;
}

// Calls check(power, m, n) for every frequency but zero.
template <class Check>
void for_each_frequency(const std::vector<double>& power, int frequencies, const Check& check) {
  const int half = frequencies / 2;
  for (int n = -half; n < half; ++n)
    for (int m = -half; m < half; ++m)
      if (m != 0 || n != 0) check(at(power, frequencies, m, n), m, n);
}

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("power is the definition's sum in quadruple precision, within the stated bound") {
    // Sizes around the block of 128 points, numbers of frequencies that leave tiles incomplete.
    double worst = 0;
    for (const int points : {1, 2, 7, 127, 128, 129, 300}) {
      for (const int frequencies : {4, 6, 10, 64, 90}) {
        PointSet set = set_of("random", points, {3, 1});
        set.x[0] = 0x1p-1074;  // the smallest double, and the largest below 1
        set.y[0] = 1 - 0x1p-53;
        const std::vector<double> power = power_of({set}, frequencies);
        REQUIRE(power.size() == static_cast<std::size_t>(frequencies * frequencies));
        for (int n = -frequencies / 2; n < frequencies / 2; n += 3) {
          for (int m = -frequencies / 2; m < frequencies / 2; m += std::max(1, frequencies / 8)) {
            const double want = brute_power(set, m, n), got = at(power, frequencies, m, n);
            const double bound = 2 * kError * std::sqrt(want * points) + kError * kError * points;
            REQUIRE(std::fabs(got - want) <= bound);
            worst = std::max(worst, std::fabs(got - want) / points);
          }
        }
      }
    }
    CHECK(worst > 0);  // the comparison compares
    MESSAGE("worst error of power: ", worst, " N");
  }

  TEST_CASE("zero frequency is exactly on the centre bin, N there, and in no ring") {
    for (const int frequencies : {4, 6, 64, 128}) {
      const std::vector<double> power = power_of({set_of("random", 100)}, frequencies);
      CHECK(at(power, frequencies, 0, 0) == 100);
      CHECK(std::max_element(power.begin(), power.end()) - power.begin() ==
            frequencies / 2 * frequencies + frequencies / 2);
      std::vector<double> without = power;
      without[static_cast<std::size_t>(frequencies / 2 * frequencies + frequencies / 2)] = 0;
      const auto with_dc = radial_power(power, frequencies, 1), no_dc = radial_power(without, frequencies, 1);
      REQUIRE(with_dc.size() == static_cast<std::size_t>(frequencies / 2 - 1));
      for (std::size_t k = 0; k < with_dc.size(); ++k) {
        CHECK(with_dc[k].frequency == static_cast<int>(k) + 1);
        CHECK(with_dc[k].power == no_dc[k].power);
      }
    }
  }

  TEST_CASE("rings are complete: their bins are the integer points of the annulus") {
    const auto rings_of_64 = radial_power(power_of({set_of("random", 10)}, 64), 64, 3);
    for (const RadialPower& ring : rings_of_64) {
      std::int64_t bins = 0;
      const int k = ring.frequency;
      for (int m = -100; m <= 100; ++m)
        for (int n = -100; n <= 100; ++n) bins += k * k - k < m * m + n * n && m * m + n * n <= k * k + k ? 1 : 0;
      CHECK(ring.bins == bins);
      CHECK(ring.degrees == 3 * bins);
    }
  }

  TEST_CASE("coincident points count as often as they occur") {
    const PointSet one{{0.3}, {0.7}}, two{{0.3, 0.3}, {0.7, 0.7}};
    for (const double p : power_of({one}, 64)) CHECK(std::fabs(p - 1) < 4 * kError);
    for (const double p : power_of({two}, 64)) CHECK(std::fabs(p - 2) < 2 * 4 * kError);
    // A set given twice over has twice the power.
    PointSet set = set_of("random", 50);
    const std::vector<double> once = power_of({set}, 32);
    set.x.insert(set.x.end(), set.x.begin(), set.x.end());
    set.y.insert(set.y.end(), set.y.begin(), set.y.end());
    const std::vector<double> twice = power_of({set}, 32);
    for (std::size_t i = 0; i < once.size(); ++i) CHECK(std::fabs(twice[i] - 2 * once[i]) < 100 * 4 * kError);
  }

  TEST_CASE("several sets are averaged by their number, whatever their sizes") {
    const PointSet a = set_of("random", 10), b = set_of("jittered", 36), c = set_of("random", 200);
    const std::vector<double> pa = power_of({a}, 32), pb = power_of({b}, 32), pc = power_of({c}, 32),
                              all = power_of({a, b, c}, 32), same = power_of({a, a, a, a}, 32);
    for (std::size_t i = 0; i < all.size(); ++i) {
      // Two additions and a division round.
      CHECK(std::fabs(all[i] - (pa[i] + pb[i] + pc[i]) / 3) <= 4 * 0x1p-53 * (pa[i] + pb[i] + pc[i]));
      CHECK(std::fabs(same[i] - pa[i]) <= 4 * 0x1p-53 * pa[i]);
    }
  }

  TEST_CASE("positions are not quantised: a billionth of the side turns the phase at high frequency") {
    // |1 + exp(-i a)|^2 / 2 = 1 + cos a, a = 2 pi m 1e-9. At m = 1000 that is less than 2 by a^2 / 2 = 2e-11, 250 times
    // the promised error; any grid of positions coarser than 1e-9 would miss it.
    const double step = (0.3 + 1e-9) - 0.3;  // what is stored
    const std::vector<double> along_x = power_of({{{0.3, 0.3 + 1e-9}, {0.5, 0.5}}}, 2048),
                              along_y = power_of({{{0.5, 0.5}, {0.3, 0.3 + 1e-9}}}, 2048);
    for (const int m : {1, 100, 1000, 1023}) {
      const double a = 2 * 3.14159265358979323846 * m * step;
      const double want = 2 - a * a / 2;  // the next term is below 1e-21
      CHECK(std::fabs(at(along_x, 2048, m, 0) - want) < 4 * kError);
      CHECK(std::fabs(at(along_y, 2048, 0, m) - want) < 4 * kError);
    }
  }

  TEST_CASE("nothing of an earlier set or spectrum remains: the same input gives the same bits") {
    const PointSet a = set_of("random", 333), b = set_of("random", 90, {2, 0});
    const std::vector<double> first = power_of({a}, 64);
    CHECK(power_of({b}, 64) != first);
    CHECK(power_of({a}, 64) == first);
    PointSpectrum spectrum(64);
    spectrum.add(a.x, a.y);
    CHECK(spectrum.power() == spectrum.power());
    CHECK(spectrum.sets() == 1);
  }

  TEST_CASE("threads and the width of vectors change no bit") {
    const PointSet set = set_of("random", 700);
    std::vector<double> one;
    {
      const ThreadLimit limit(1);
      one = power_of({set, set}, 128);
    }
    const ThreadLimit limit(4);
    CHECK(power_of({set, set}, 128) == one);

    const PointSet rows = set_of("random", 4 * 77), columns = set_of("random", 8 * 77, {2, 2});
    const auto tile = [&](TileKernel kernel) {
      std::vector<double> sums(kTileRows * kTileColumns, -1.0);
      kernel(77, rows.x.data(), columns.x.data(), sums.data());
      return sums;
    };
    const std::vector<double> plain = tile(tile_kernels().front());
    for (const TileKernel kernel : tile_kernels()) CHECK(tile(kernel) == plain);
    double sum = 0;  // of row 2 and column 5, in the order of the points
    for (std::size_t i = 0; i < 77; ++i) sum += rows.x[4 * i + 2] * columns.x[8 * i + 5];
    CHECK(plain[2 * kTileColumns + 5] == sum);
  }

  TEST_CASE("power is the same at f and -f") {
    for (const std::string& text : test::variants()) {
      CAPTURE(text);
      const int n = test::usable(test::chosen(text), 60);
      const std::vector<double> power = power_of({set_of(text, n)}, 32);
      for (int v = -15; v < 16; ++v)
        for (int u = -15; u < 16; ++u) CHECK(at(power, 32, u, v) == at(power, 32, -u, -v));
    }
  }

  TEST_CASE("moving all points on the torus changes no power") {
    PointSet set = set_of("jittered", 100);
    const std::vector<double> before = power_of({set}, 64);
    for (double& x : set.x) x = x < 0.625 ? x + 0.375 : x - 0.625;
    for (double& y : set.y) y = y < 0.9375 ? y + 0.0625 : y - 0.9375;
    const std::vector<double> after = power_of({set}, 64);
    // The moved positions are rounded to 2^-53: phases change by 2 pi 45 2^-54 at most, which is 2e-14 of |sum| / N.
    for (std::size_t i = 0; i < before.size(); ++i) CHECK(std::fabs(after[i] - before[i]) < 100 * 4 * (2 * kError));
  }

  TEST_CASE("a regular grid has power N at multiples of its side and none elsewhere") {
    for (const int cells : {2, 5, 16, 40}) {
      const int points = cells * cells, frequencies = 128;
      for_each_frequency(power_of({set_of("regular", points)}, frequencies), frequencies, [&](double p, int m, int n) {
        const bool peak = m % cells == 0 && n % cells == 0;
        // Positions (i + 1/2) / cells are rounded to 2^-54: phases at frequency 90 are off by
        // 2 pi 90 2^-54 = 3.2e-14 each; |sum| / N is within that and kError of 0 or 1.
        const double error = 3.2e-14 + kError;
        CHECK(std::fabs(p - (peak ? points : 0)) < (peak ? 2 * error : error * error) * points);
      });
    }
  }

  TEST_CASE("random points have mean power 1 at every frequency and in every ring, with about the width of the band") {
    constexpr int kSets = 200, kFrequencies = 64;
    const std::vector<double> power = power_of(draws("random", 64, kSets), kFrequencies);
    // Powers of different frequencies are uncorrelated, with variance 1 - 1/N; a mean of 200 is about normal, of
    // relative error 0.071. Of 2,048 distinct ones none should be 5.5 away (chance 1e-4, with the skewness of a gamma
    // law).
    double largest = 0;
    for_each_frequency(power, kFrequencies, [&](double p, int, int) { largest = std::max(largest, std::fabs(p - 1)); });
    CHECK(largest < 5.5 * std::sqrt(1.0 / kSets));
    const auto radial = radial_power(power, kFrequencies, kSets);
    int outside = 0;
    for (const RadialPower& ring : radial) {
      outside += ring.band.lo <= 1 && 1 <= ring.band.hi ? 0 : 1;
      // Isotropic: -10 log10(200) = -23.0 dB; rings of 8 bins and more, 4 numbers: s^2 within a factor of 10.
      CHECK(std::fabs(ring.anisotropy_db + 10 * std::log10(kSets)) < 10);
    }
    // Binomial with 31 rings at 5%: 6 or more have a chance of 0.4%.
    CHECK(outside < 6);
  }

  TEST_CASE("jittered points have the power of theory, 1 - sinc^2 sinc^2, at every frequency") {
    constexpr int kCells = 10, kPoints = kCells * kCells, kSets = 200, kFrequencies = 64;
    for (const double amount : {1.0, 0.5}) {
      CAPTURE(amount);
      const std::string text = amount == 1 ? "jittered" : "jittered:amount=0.5";
      const std::vector<double> power = power_of(draws(text, kPoints, kSets), kFrequencies);
      int outside = 0, tried = 0;
      for_each_frequency(power, kFrequencies, [&](double p, int m, int n) {
        if (n < 0 || (n == 0 && m < 0)) return;  // one of each pair
        const double want = jittered_power(kCells, amount, m, n);
        if (want > kPoints / 20) return;  // peaks of the lattice: not a chi-square
        ++tried;
        // Sums over 100 independent cells are nearly Gaussian: each power is an exponential number with the mean
        // `want`, if real and imaginary part are alike, and never has more than the variance of one degree of freedom.
        // So 6 standard deviations of 1 degree.
        CHECK(std::fabs(p - want) < 6 * want * std::sqrt(2.0 / kSets));
        outside += std::fabs(p - want) > 1.96 * want * std::sqrt(1.0 / kSets) ? 1 : 0;
      });
      CHECK(tried > 2000);
      // About 5%; on the axes of the lattice, where real and imaginary part differ, more.
      CHECK(outside < tried * 0.08);
    }
    // Rings: theory's mean over the ring's bins is inside the band in 19 of 20.
    const std::vector<double> power = power_of(draws("jittered", kPoints, kSets), kFrequencies);
    std::vector<double> theory;
    for (int n = -kFrequencies / 2; n < kFrequencies / 2; ++n)
      for (int m = -kFrequencies / 2; m < kFrequencies / 2; ++m) theory.push_back(jittered_power(kCells, 1, m, n));
    const auto got = radial_power(power, kFrequencies, kSets), want = radial_power(theory, kFrequencies, 1);
    int outside = 0;
    for (std::size_t k = 0; k < got.size(); ++k)
      outside += got[k].band.lo <= want[k].power && want[k].power <= got[k].band.hi ? 0 : 1;
    CHECK(outside < 6);  // as for random points
    // Ring 1 has (1, 0) and (1, 1), four bins each: with q = sinc^2(1/10), 1 - (q + q^2) / 2.
    const double angle = 3.14159265358979323846 / 10, q = std::pow(std::sin(angle) / angle, 2);
    CHECK(std::fabs(want[0].power - (1 - (q + q * q) / 2)) < 1e-15);
    CHECK(std::fabs(want[30].power - 1) < 0.05);
  }

  TEST_CASE("the power that theory gives jittered points has its known limits") {
    for (const int cells : {1, 3, 8}) {
      const double points = cells * cells;
      for (int m = -20; m <= 20; ++m) {
        for (int n = -20; n <= 20; ++n) {
          if (m == 0 && n == 0) continue;
          const bool lattice = m % cells == 0 && n % cells == 0;
          CHECK(jittered_power(cells, 0, m, n) == (lattice ? points : 0));
          if (lattice) CHECK(jittered_power(cells, 1, m, n) == 1);
          CHECK(jittered_power(cells, 1, m, n) <= 1);
          CHECK(jittered_power(cells, 1, m, n) >= 0);
          if (cells == 1) CHECK(jittered_power(1, 1, m, n) == 1);  // one random point
        }
      }
      CHECK(jittered_power(cells, 0.7, 0, 0) == points);
    }
    // 1 - (sin(pi/2) / (pi/2))^2 at half the grid's frequency along an axis.
    CHECK(std::fabs(jittered_power(8, 1, 4, 0) - (1 - 4 / (3.14159265358979323846 * 3.14159265358979323846))) < 1e-15);
  }

  TEST_CASE("dart-throwing has no low frequencies, a hole that jittered points fill in part") {
    const auto dart = radial_power(power_of(draws("dart-throwing", 256, 8), 128), 128, 8);
    const auto jittered = radial_power(power_of(draws("jittered", 256, 8), 128), 128, 8);
    // sqrt(256) = 16 cycles is the frequency of the points; rings 3 to 8 are well inside the hole, whose floor for
    // dart-throwing is about 0.05 (and random points have 1).
    double low_dart = 0, low_jittered = 0, peak = 0;
    for (std::size_t k = 2; k < 8; ++k) {
      low_dart += dart[k].power / 6;
      low_jittered += jittered[k].power / 6;
    }
    for (const RadialPower& ring : dart) peak = std::max(peak, ring.power);
    CHECK(low_dart < 0.12);
    CHECK(low_dart < low_jittered);
    CHECK(peak > 1.2);  // what is missing at low frequencies stands in a ring at sqrt(N) and above
  }

  TEST_CASE("the usual number of frequencies reaches four times the frequency of the points") {
    CHECK(usual_frequencies(1) == 64);
    CHECK(usual_frequencies(64) == 64);
    CHECK(usual_frequencies(65) == 128);
    CHECK(usual_frequencies(1600) == 512);
    CHECK(usual_frequencies(4096) == 512);
    CHECK(usual_frequencies(4097) == 1024);
    CHECK(usual_frequencies(std::int64_t{1} << 40) == 1024);
  }
}
