// L2 discrepancy of disks on the torus against integration over centres and radii, closed forms and symmetry.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <numbers>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/hash.h"
#include "core/parallel.h"
#include "gauss.h"
#include "measure/discrepancy/disk_l2.h"
#include "measure/discrepancy/disk_overlap.h"
#include "measure/discrepancy/disk_pairs.h"
#include "patterns/variants.h"

using namespace moire;
using moire::test::PointSet;
using moire::test::set_of;

namespace {

constexpr double kPi = std::numbers::pi;
// Absolute errors of T^2 that the header promises, for random radii and for one radius.
constexpr double kPromised = 1e-15, kPromisedFixed = 3e-15;

double disk_l2(const PointSet& set) { return disk_l2_squared({set.x, set.y}); }
double disk_l2(const PointSet& set, double radius) { return disk_l2_squared({set.x, set.y}, radius); }

double on_torus(double v) { return v - std::floor(v); }

// Calls use(dx, dy) for the differences of all pairs i > j, with all images that a disk of radius 1/2 can reach.
template <class Use>
void for_each_image(const PointSet& set, const Use& use) {
  for (std::size_t i = 0; i < set.x.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      for (int kx = -1; kx <= 1; ++kx)
        for (int ky = -1; ky <= 1; ++ky) use(i, set.x[j] + kx - set.x[i], set.y[j] + ky - set.y[i]);
}

// Integral over c_y of (share of points in the disk around (c_x, c_y) - its area)^2: the share is constant between the
// ends of the points' chords.
double integral_over_column(const PointSet& set, double radius, double center_x) {
  struct Chord {
    double y, half;
  };
  std::vector<Chord> chords;
  std::vector<double> breaks = {0, 1};
  for (std::size_t i = 0; i < set.x.size(); ++i) {
    const double d = std::fabs(on_torus(set.x[i] - center_x)), dx = std::min(d, 1 - d);
    if (dx >= radius) continue;
    const double half = std::sqrt((radius - dx) * (radius + dx));
    chords.push_back({set.y[i], half});
    breaks.push_back(on_torus(set.y[i] - half));
    breaks.push_back(on_torus(set.y[i] + half));
  }
  std::sort(breaks.begin(), breaks.end());
  double sum = 0;
  for (std::size_t b = 0; b + 1 < breaks.size(); ++b) {
    const double middle = 0.5 * (breaks[b] + breaks[b + 1]);
    int inside = 0;
    for (const Chord& chord : chords) {
      const double d = on_torus(chord.y - middle);
      inside += std::min(d, 1 - d) < chord.half;
    }
    const double difference = inside / static_cast<double>(set.x.size()) - kPi * radius * radius;
    sum += (breaks[b + 1] - breaks[b]) * difference * difference;
  }
  return sum;
}

// T^2 by its definition for one radius. Columns are cut where a chord begins, ends or is longest, and where ends of two
// chords meet, which is where two circles cross. Chords have the root of the distance from such a place in them:
// 3 t^2 - 2 t^3 makes that smooth at both ends of a piece.
double by_definition(const PointSet& set, double radius) {
  std::vector<double> breaks = {0, 1};
  for (const double x : set.x)
    for (const double v : {x, x - radius, x + radius}) breaks.push_back(on_torus(v));
  for_each_image(set, [&](std::size_t i, double dx, double dy) {
    const double d = std::hypot(dx, dy);
    if (d == 0 || d >= 2 * radius) return;
    const double along = std::sqrt((radius - d / 2) * (radius + d / 2));
    for (const double side : {-1.0, 1.0}) breaks.push_back(on_torus(set.x[i] + dx / 2 + side * along * dy / d));
  });
  std::sort(breaks.begin(), breaks.end());
  static const auto rule = test::gauss(40);
  double sum = 0;
  for (std::size_t b = 0; b + 1 < breaks.size(); ++b) {
    const double length = breaks[b + 1] - breaks[b];
    if (length < 1e-15) continue;
    for (const auto& [t, weight] : rule)
      sum += weight * length * 6 * t * (1 - t) *
             integral_over_column(set, radius, breaks[b] + length * t * t * (3 - 2 * t));
  }
  return sum;
}

// Over radii: cut where two disks begin to touch, where the overlap begins like the root of the third power.
double by_radii(const PointSet& set) {
  std::vector<double> breaks = {0, 0.5};
  for_each_image(set, [&](std::size_t, double dx, double dy) { breaks.push_back(std::hypot(dx, dy) / 2); });
  // Each point touches its own images at 1/2.
  std::sort(breaks.begin(), breaks.end());
  static const auto rule = test::gauss(24);
  double sum = 0;
  for (std::size_t b = 0; b + 1 < breaks.size() && breaks[b] < 0.5; ++b) {
    const double length = breaks[b + 1] - breaks[b];
    if (length < 1e-15) continue;
    for (const auto& [t, weight] : rule) sum += weight * length * 2 * t * 2 * disk_l2(set, breaks[b] + length * t * t);
  }
  return sum;
}

// What a pair contributes, by the table one image at a time.
double by_table(const DiskOverlap& overlap, double radius, double dx, double dy) {
  const double scale = 1 / (4 * radius * radius), a = std::fabs(dx), b = std::fabs(dy);
  const auto square = [](double v) { return v * v; };
  const double u = std::min(a, 1 - a), v = std::min(b, 1 - b), far_u = std::max(a, 1 - a), far_v = std::max(b, 1 - b);
  if (radius <= 0.25) return overlap((square(u) + square(v)) * scale);
  const double x2 = square(u) * scale, y2 = square(v) * scale, far_x2 = square(far_u) * scale,
               far_y2 = square(far_v) * scale;
  return (overlap(x2 + y2) + overlap(far_x2 + far_y2)) + (overlap(far_x2 + y2) + overlap(x2 + far_y2));
}

void check_definition(const PointSet& set, double tolerance) {
  for (const double radius : {0.01, 0.11, 0.25, 0.3, 0.45, 0.5}) {
    CAPTURE(radius);
    CHECK(std::fabs(disk_l2(set, radius) - by_definition(set, radius)) <= tolerance);
  }
}

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("disk L2 has the golden values of Zaremba and Hammersley points to 1e-15") {
    struct Golden {
      const char* pattern;
      int n;
      double squared;
    };
    // Computed with 113 bits from coordinates of 113 bits.
    constexpr Golden kGolden[] = {
        {"zaremba", 16, 2.12010660840501825068e-03},     {"zaremba", 256, 3.25374092894472125748e-05},
        {"zaremba", 1600, 2.07401515611399822049e-06},   {"hammersley", 16, 2.14180315706880349626e-03},
        {"hammersley", 256, 3.26524830323781176833e-05}, {"hammersley", 1600, 2.07760066993887036314e-06},
    };
    for (const Golden& g : kGolden) {
      CAPTURE(g.pattern);
      CAPTURE(g.n);
      CHECK(std::fabs(disk_l2(set_of(g.pattern, g.n)) - g.squared) <= kPromised);
    }
  }

  TEST_CASE("the tables of overlaps equal their functions to 1e-15 and 5e-16") {
    double worst_lens = 0, worst_mean = 0;
    // Every piece of both ends at several places, and where a table begins and hands over: 2^-110, 1/2, 1.
    std::vector<long double> ends;
    for (int halving = 1; halving < 116; ++halving)
      for (int k = 0; k < 300; ++k) ends.push_back(std::ldexp(1 + k / 300.0L, -halving - 1));
    for (const long double v : {0.0L, 0x1p-1074L, 0x1p-300L, 0x1p-110L, 0x1.1p-110L, 0x1.0fffp-110L, 0.5L})
      ends.push_back(v);
    const auto check = [&](double q) {
      const long double p = 1 - static_cast<long double>(q), c = std::sqrt(static_cast<long double>(q));
      const long double s = std::sqrt(p), angle = std::atan2(s, c);
      const long double lens = 2 * (angle - c * s);
      const long double logarithm = q > 0 ? c * c * c * std::log((1 + s) / c) : 0;
      const long double mean = (angle - 2 * c * s + logarithm) * 2 / 3;
      worst_lens =
          std::max(worst_lens, static_cast<double>(std::fabs(static_cast<long double>(DiskOverlap::lens()(q)) - lens)));
      worst_mean = std::max(
          worst_mean, static_cast<double>(std::fabs(static_cast<long double>(DiskOverlap::mean_lens()(q)) - mean)));
    };
    for (const long double m : ends) {
      check(static_cast<double>(m));
      check(static_cast<double>(1 - m));
    }
    MESSAGE("worst errors of overlaps: ", worst_lens, " of ", kPi, ", ", worst_mean, " of ", kPi / 3);
    CHECK(worst_lens < 1e-15);  // what the header says
    CHECK(worst_mean < 5e-16);
    for (const double q : {1.0, 1 + 0x1p-52, 1.0001, 2.0, 1e300}) {
      CHECK(DiskOverlap::lens()(q) == 0);
      CHECK(DiskOverlap::mean_lens()(q) == 0);
    }
    CHECK(DiskOverlap::lens()(0) == doctest::Approx(kPi).epsilon(1e-15));
    CHECK(DiskOverlap::mean_lens()(0) == doctest::Approx(kPi / 3).epsilon(1e-15));
  }

  TEST_CASE("disk L2 of a fixed radius is the mean over centres, integrated column by column, for every pattern") {
    // A root just beyond the end of a piece slows the rule of 40 nodes down: measured, it is within 6e-14.
    for (const std::string& text : moire::test::variants()) {
      CAPTURE(text);
      check_definition(set_of(text, moire::test::usable(moire::test::chosen(text), 4)), 1e-12);
    }
    for (const int n : {1, 2, 3, 8, 12})
      check_definition(set_of("random", n, {3, static_cast<std::uint32_t>(n)}), 1e-12);
  }

  TEST_CASE("disk L2 is right for coincident and collinear points and points on the border") {
    const std::vector<PointSet> sets = {
        {{0.25, 0.25, 0.25, 0.75}, {0.5, 0.5, 0.5, 0.125}},
        {{0.125, 0.25, 0.5, 0.875}, {0.125, 0.25, 0.5, 0.875}},
        {{0.25, 0.25, 0.25}, {0, 0.5, 0.75}},
        {{0, 0, 0, 0.5, 1 - 0x1p-53}, {0, 1.0 / 3, 0.75, 0, 1 - 0x1p-53}},
        {{0x1p-1074, 0x1p-600, 0.5}, {0, 0x1p-600, 0x1p-1074}},
    };
    for (const PointSet& set : sets) check_definition(set, 1e-12);
  }

  TEST_CASE("disk L2 is the mean of fixed radii over radii from 0 to a half") {
    for (const char* pattern : {"random", "zaremba", "jittered", "hammersley"})
      for (const int n : {1, 4, 9}) {
        const PointSet set = set_of(pattern, n, {9, 1});
        // 24 nodes converge to rounding; both sides keep to their promises, the fixed radius at half its worst.
        CHECK(std::fabs(disk_l2(set) - by_radii(set)) < 3e-15);
      }
    const PointSet border{{0, 0, 0.5, 0.5}, {0, 0, 0, 0.5}};
    CHECK(std::fabs(disk_l2(border) - by_radii(border)) < 3e-15);
  }

  TEST_CASE("disk L2 of one point, or of coincident ones, is the mean of A (1 - A)") {
    for (const std::size_t n : {1u, 2u, 300u}) {
      const PointSet set{std::vector<double>(n, 0.3), std::vector<double>(n, 0.9)};
      CHECK(std::fabs(disk_l2(set) - (kPi / 12 - kPi * kPi / 80)) <= kPromised);
      for (const double radius : {1e-3, 0.1, 0.25, 0.4, 0.5}) {
        const double area = kPi * radius * radius;
        CHECK(std::fabs(disk_l2(set, radius) - area * (1 - area)) <= kPromisedFixed);
      }
    }
  }

  TEST_CASE("disk L2 does not change with a shift on the torus, a symmetry of the square or the order of points") {
    PointSet set;
    const Key key = pixel_key(draw_hash(13, 0), {0, 0});
    for (std::uint32_t i = 0; i < 200; ++i) {
      const Words w = hash(key, i, Axis::xy);
      set.x.push_back(w.a % 1024 / 1024.0);
      set.y.push_back(w.b % 1024 / 1024.0);
    }
    const auto check = [&](const PointSet& moved) {
      CHECK(std::fabs(disk_l2(moved) - disk_l2(set)) <= kPromised);
      for (const double radius : {0.05, 0.25, 0.4})
        CHECK(std::fabs(disk_l2(moved, radius) - disk_l2(set, radius)) <= kPromisedFixed);
    };
    for (const auto& [dx, dy] : {std::pair{0.5, 0.25}, std::pair{3.0 / 1024, 1021.0 / 1024}, std::pair{0.1, 0.7}}) {
      PointSet moved = set;
      for (double& x : moved.x) x = on_torus(x + dx);
      for (double& y : moved.y) y = on_torus(y + dy);
      check(moved);
    }
    PointSet turned{set.y, set.x};
    for (double& x : turned.x) x = on_torus(1 - x);
    std::reverse(turned.x.begin(), turned.x.end());
    std::reverse(turned.y.begin(), turned.y.end());
    check(turned);
  }

  TEST_CASE("all loops over pairs give the bits of the table, one image at a time, for disks of any size") {
    // Points at random, on a lattice whose differences are the places of no overlap and of the whole disk, and nearer
    // to each other and to distance 1 than the tables go.
    for (const int kind : {0, 1, 2}) {
      PointSet set;
      const Key key = pixel_key(draw_hash(14, 0), {kind, 0});
      for (std::uint32_t i = 0; i < 256; ++i) {
        const Words w = hash(key, i, Axis::xy);
        const double shrink = kind == 2 ? std::ldexp(1.0, -static_cast<int>(w.c % 300)) : 1;
        set.x.push_back(kind == 1 ? w.a % 8 / 8.0 : unit(w.a, w.b) * shrink);
        set.y.push_back(kind == 1 ? w.b % 8 / 8.0 : unit(w.c, w.d) * shrink);
      }
      for (const DiskOverlap* overlap : {&DiskOverlap::lens(), &DiskOverlap::mean_lens()})
        for (const double radius : {0.01, 0.25, 0.3, 0.5}) {
          const double scale = 1 / (4 * radius * radius);
          const auto loops = radius <= 0.25 ? disk_terms_of_one_image() : disk_terms();
          for (std::size_t i = 0; i < set.x.size(); ++i)
            for (std::size_t j = 0; j < set.x.size(); j += kPairLanes) {
              const std::span<const double> x{&set.x[j], kPairLanes}, y{&set.y[j], kPairLanes};
              PairRow plain{};
              loops.front()(*overlap, scale, set.x[i], set.y[i], x, y, plain);
              for (const DiskTerms terms : loops) {
                PairRow fast{};
                terms(*overlap, scale, set.x[i], set.y[i], x, y, fast);
                CHECK(std::memcmp(&plain, &fast, sizeof plain) == 0);
              }
              for (std::size_t lane = 0; lane < kPairLanes; ++lane)
                CHECK(plain[lane] == by_table(*overlap, radius, set.x[i] - x[lane], set.y[i] - y[lane]));
            }
        }
    }
  }

  TEST_CASE("disk L2 of any number of points is the sum over their pairs, also where they do not fill the lanes") {
    for (int n = 1; n < 40; ++n) {
      const PointSet set = set_of("random", n, {23, 0});
      // Sums of a few thousand terms of order 1, divided by n^2.
      for (const double radius : {0.2, 0.5}) {
        double sum = 0;
        for (std::size_t i = 0; i < set.x.size(); ++i)
          for (std::size_t j = 0; j < set.x.size(); ++j)
            for (int kx = -1; kx <= 1; ++kx)
              for (int ky = -1; ky <= 1; ++ky) {
                const double d = std::hypot(set.x[j] + kx - set.x[i], set.y[j] + ky - set.y[i]) / (2 * radius);
                if (d < 1) sum += 2 * (std::acos(d) - d * std::sqrt(1 - d * d));
              }
        const double area = kPi * radius * radius;
        CHECK(std::fabs(disk_l2(set, radius) - (radius * radius * sum / (n * n) - area * area)) < 1e-14);
      }
    }
  }

  TEST_CASE("disk L2 has the same bits for any number of threads") {
    const PointSet set = set_of("random", 1100);
    const double want = disk_l2(set), fixed = disk_l2(set, 0.1);
    for (const int threads : {1, 2, 5}) {
      const ThreadLimit limit(threads);
      CHECK(disk_l2(set) == want);
      CHECK(disk_l2(set, 0.1) == fixed);
    }
  }

  TEST_CASE("disk L2 of random points has the expected mean within 3 standard errors") {
    for (const int n : {4, 16, 64}) {
      for (const double radius : {0.0, 0.1, 0.4}) {  // 0: uniform in [0, 1/2]
        constexpr int kTrials = 1000;
        double sum = 0, squares = 0;
        for (std::uint32_t t = 0; t < kTrials; ++t) {
          const PointSet set = set_of("random", n, {22, t});
          const double value = radius > 0 ? disk_l2(set, radius) : disk_l2(set);
          sum += value;
          squares += value * value;
        }
        const double mean = sum / kTrials, error = std::sqrt((squares / kTrials - mean * mean) / (kTrials - 1));
        const double area = kPi * radius * radius;
        const double want = (radius > 0 ? area * (1 - area) : kPi / 12 - kPi * kPi / 80) / n;
        CAPTURE(n);
        CAPTURE(radius);
        CHECK(std::fabs(mean - want) < 3 * error);
      }
    }
  }
}
