// Exact values of many disks: the sum of those of each disk, and in total their area.
#include <doctest/doctest.h>

#include <cmath>
#include <iomanip>
#include <numbers>
#include <utility>

#include "engine/exact.h"
#include "filter_list.h"
#include "oracle/coverage.h"
#include "oracle/kernel.h"
#include "scenes.h"
#include "testimages/disk_sets.h"

namespace moire {
namespace {

using test::Random;

std::vector<GivenCircle> moved(std::vector<GivenCircle> disks, double by) {
  for (GivenCircle& d : disks) d.center = {d.center.x + by, d.center.y + by};
  return disks;
}

long double area_of(const std::vector<GivenCircle>& disks) {
  long double sum = 0;
  for (const GivenCircle& d : disks) sum += static_cast<long double>(d.radius) * static_cast<long double>(d.radius);
  return std::numbers::pi_v<long double> * sum;
}

// Disks that touch, of all sizes down to 2^-40 of the largest, in 24 x 24 pixels; every coordinate is exact.
std::vector<GivenCircle> hard_disks(std::size_t count) {
  Random random(31);
  return moved(test::random_disks(random, count, 24, 0.9, 1), 12);
}

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("box values of disks equal the oracle's areas") {
    Random random(34);
    const std::vector<GivenCircle> disks = hard_disks(120);
    const TestImage scene = scenes::disks(test::rows_of(disks));
    const Filter box(parse_spec("box", "test"));
    for (int i = 0; i < 150; ++i) {
      const Pixel p{static_cast<std::int64_t>(random.uniform(11, 37)),
                    static_cast<std::int64_t>(random.uniform(11, 37))};
      const Exact got = exact_pixel(scene, box, p);
      long double sum = 0, error = 0;
      for (const GivenCircle& d : disks) {
        const oracle::Value one = oracle::coverage(oracle::Disk{{d.center.x, d.center.y}, d.radius}, p, 1);
        sum += one.value;
        error += one.error;
      }
      const long double off = std::fabs(static_cast<long double>(got.value) - sum);
      CHECK(off <= static_cast<long double>(got.bound) + error);
      CHECK(off <= 1e-13L);  // moire's promise for box values
    }
  }

  TEST_CASE("ten thousand disks in one pixel have the sum of their areas") {
    Random random(35);
    const std::vector<GivenCircle> disks = test::random_disks(random, 10000, 1, 0.2, 1);
    const Exact got = exact_pixel(scenes::disks(test::rows_of(disks)), Filter(parse_spec("box", "test")), {0, 0});
    const double off = static_cast<double>(std::fabs(static_cast<long double>(got.value) - area_of(disks)));
    CHECK(off <= got.bound);
    CHECK(off <= 1e-13);
    MESSAGE("10000 disks in a pixel: error " << off << ", bound " << got.bound);
  }

  TEST_CASE("the order of the list changes no bit") {
    Random random(36);
    std::vector<GivenCircle> disks = hard_disks(300);
    const TestImage scene = scenes::disks(test::rows_of(disks));
    for (std::size_t i = disks.size(); i > 1; --i) std::swap(disks[i - 1], disks[random.below(i)]);
    const TestImage shuffled = scenes::disks(test::rows_of(disks));
    const Filter filter(parse_spec("mitchell", "test"));
    const ActiveRows rows = enumerate(scene, filter.radius());
    const Reference a = exact(scene, filter, rows), b = exact(shuffled, filter, enumerate(shuffled, filter.radius()));
    CHECK(a.value == b.value);
    CHECK(a.bound == b.bound);
  }
}

TEST_SUITE("heavy") {
  TEST_CASE("a million disks are read, checked for overlaps and enumerated, and cover what they cover") {
    Random random(37);
    for (const double depth : {0.0, 0.5}) {
      const std::vector<GivenCircle> disks = moved(test::random_disks(random, 1000000, 1024, depth, 1), 1);
      const TestImage scene = scenes::disks(test::rows_of(disks), {1026, 1026});
      const ActiveRows rows = enumerate(scene, 0.5);
      std::int64_t all = 0;
      for (int y = 0; y < 1026; ++y)
        for (const Run& run : rows.row(y))
          if (run.cover == Cover::all) all += run.x1 - run.x0;
      // Flat white pixels are a part of the area, and with the active ones more than it.
      const double area = static_cast<double>(area_of(disks));
      CHECK(static_cast<double>(all) <= area);
      CHECK(static_cast<double>(all + rows.active_pixels()) >= area);
    }
  }

  TEST_CASE("the value of a pixel is the sum of its disks' values, within the bounds") {
    Random random(33);
    const std::vector<GivenCircle> disks = hard_disks(120);
    const TestImage scene = scenes::disks(test::rows_of(disks));
    for (const std::string& text : test::filter_texts()) {
      const Filter filter(parse_spec(text, "test"));
      CAPTURE(text);
      for (int i = 0; i < 60; ++i) {
        const Pixel p{static_cast<std::int64_t>(random.uniform(11, 37)),
                      static_cast<std::int64_t>(random.uniform(11, 37))};
        const Exact all = exact_pixel(scene, filter, p);
        long double sum = 0, bound = 0;
        for (const GivenCircle& d : disks) {
          const Exact one = exact_pixel(scenes::disk(d.center, d.radius), filter, p);
          sum += static_cast<long double>(one.value);
          bound += static_cast<long double>(one.bound);
        }
        CAPTURE(p.x);
        CAPTURE(p.y);
        // One rounding of the whole sum, below 1.
        CHECK(std::fabs(static_cast<long double>(all.value) - sum) <=
              bound + static_cast<long double>(all.bound) + 0x1p-53L);
        CHECK(static_cast<long double>(all.bound) <= bound + 0x1p-50L);
      }
    }
  }

  TEST_CASE("the pixels of disks sum to their area for filters that are partitions of unity") {
    Random random(32);
    // With room around for every window; tiny disks and touching ones among them.
    const std::vector<GivenCircle> sets[] = {moved(test::random_disks(random, 200, 24, 0, 0.9), 8),
                                             moved(test::random_disks(random, 200, 24, 0.9, 1), 8)};
    int partitions = 0;
    for (const std::string& text : test::separable_texts()) {
      if (oracle::Kernel(text).ripple() > 1e-14L) continue;
      const Filter filter(parse_spec(text, "test"));
      CAPTURE(text);
      ++partitions;
      for (const auto& disks : sets) {
        const TestImage scene = scenes::disks(test::rows_of(disks), {40, 40});
        const ActiveRows rows = enumerate(scene, filter.radius());
        const Reference reference = exact(scene, filter, rows);
        long double sum = 0;
        for (const double v : reference.value) sum += static_cast<long double>(v);
        for (int y = 0; y < 40; ++y)
          for (const Run& run : rows.row(y))
            if (run.cover == Cover::all) sum += static_cast<long double>(run.x1 - run.x0);
        // The promise of moire for totals.
        CHECK(static_cast<double>(std::fabs(sum / area_of(disks) - 1)) <= 1e-13);
      }
    }
    CHECK(partitions >= 5);  // box, tent, B-splines, mitchell, catmull-rom at least
  }
}

}  // namespace moire
