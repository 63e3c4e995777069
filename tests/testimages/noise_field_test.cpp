// The scene `noise-field`: its disks by their law, what it answers, what it refuses.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "core/error.h"
#include "core/hash.h"
#include "scenes.h"
#include "testimages/disk_index.h"
#include "testimages/disk_sets.h"
#include "testimages/noise_disks.h"

using namespace moire;
using namespace moire::test;

namespace {

std::vector<GivenCircle> usual_disks(Grid grid, std::uint64_t seed = 1) {
  const auto count = static_cast<std::int64_t>(std::round(1.2 * field_area(grid)));
  return make_noise_disks({count, 0.2, 0.3, seed}, grid, "test");
}

TestImage field(const Given& given, Grid grid = {64, 64}) {
  return {find_testimage("noise-field", ""), given, grid, "s.toml:1:1"};
}

std::string refusal(const Given& given, Grid grid = {64, 64}) {
  Given at = given;
  for (auto& [key, value] : at) value.place = "s.toml:4:9";
  try {
    field(at, grid);
  } catch (const Error& e) {
    return e.what();
  }
  return {};
}

bool says(const std::string& message, const std::string& part) { return message.find(part) != std::string::npos; }

// In long double, whose 11 more bits decide what is asked here.
long double gap(const GivenCircle& a, const GivenCircle& b) {
  const long double dx = static_cast<long double>(a.center.x) - static_cast<long double>(b.center.x),
                    dy = static_cast<long double>(a.center.y) - static_cast<long double>(b.center.y);
  return std::sqrt(dx * dx + dy * dy) - static_cast<long double>(a.radius) - static_cast<long double>(b.radius);
}

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("disks of a noise field are as many as asked, of the radii asked, inside image and margin, and disjoint") {
    const Grid grids[] = {{64, 64}, {1, 1}, {200, 7}};
    struct Asked {
      double share, lo, hi;  // of the largest count
    };
    for (const Grid grid : grids) {
      for (const Asked a : {Asked{0.3, 0.15, 0.35}, {1, 0.3, 0.3}, {1, 1e-6, 8}, {1, 8, 8}, {0.02, 0.01, 0.5}}) {
        CAPTURE(a.hi);
        const auto most = most_noise_disks(a.lo, a.hi, grid);
        const auto count = std::max<std::int64_t>(1, static_cast<std::int64_t>(a.share * static_cast<double>(most)));
        const auto disks = make_noise_disks({count, a.lo, a.hi, 5}, grid, "test");
        REQUIRE(static_cast<std::int64_t>(disks.size()) == count);
        CHECK(std::is_sorted(disks.begin(), disks.end(),
                             [](const GivenCircle& x, const GivenCircle& y) { return x.radius > y.radius; }));
        int outside = 0;
        for (const GivenCircle& d : disks) {
          const auto [x, y] = d.center;
          outside += d.radius < a.lo || d.radius > a.hi || std::min(x, y) < -kFieldMargin ||
                     x > grid.width + kFieldMargin || y > grid.height + kFieldMargin;
        }
        CHECK(outside == 0);
        CHECK_FALSE(DiskIndex(disks).find_overlap().has_value());
      }
    }
  }

  TEST_CASE("the disks of a noise field follow their law: by brute force, the first candidate that is free") {
    const Grid grid{20, 10};
    const NoiseDisks asked{4000, 0.1, 0.5, 9};
    const auto disks = make_noise_disks(asked, grid, "test");
    const Key key = pixel_key(draw_hash(9, 0), {});
    std::vector<double> radii;
    for (std::uint32_t k = 0; k < 4000; ++k) {
      const Words w = hash(key, k, Axis::field, 0);
      radii.push_back(0.1 + (0.5 - 0.1) * unit(w.a, w.b));
    }
    std::sort(radii.rbegin(), radii.rend());
    int wrong = 0;
    for (std::size_t k = 0; k < disks.size(); ++k) {
      wrong += disks[k].radius != radii[k];
      for (std::uint32_t part = 1;; ++part) {
        const Words w = hash(key, static_cast<std::uint32_t>(k), Axis::field, part);
        const GivenCircle candidate{{unit(w.a, w.b) * 148 - 64, unit(w.c, w.d) * 138 - 64}, radii[k]};
        const bool taken = candidate.center == disks[k].center;
        const bool free = std::none_of(disks.begin(), disks.begin() + static_cast<std::ptrdiff_t>(k),
                                       [&](const GivenCircle& d) { return gap(d, candidate) < 0; });
        wrong += taken != free;
        if (taken || free) break;
      }
    }
    CHECK(wrong == 0);
  }

  TEST_CASE("a noise field answers as the list of its disks does") {
    Random random(21);
    const Grid grid{64, 48};
    const auto count = static_cast<std::int64_t>(std::round(1.2 * field_area(grid)));
    const TestImage scene = field({}, grid), list = scenes::disks(rows_of(usual_disks(grid)), grid);
    const StoredDoubles stored = scene.stored();
    CHECK(stored == StoredDoubles{{"count", {static_cast<double>(count)}}, {"radius", {0.2, 0.3}}, {"seed", {1}}});
    int wrong = 0;
    for (int i = 0; i < 400; ++i) {
      const Pixel pixel{static_cast<std::int64_t>(random.uniform(-40, 104)),
                        static_cast<std::int64_t>(random.uniform(-40, 88))};
      std::vector<double> x(50), y(50);
      for (double& v : x) v = random.uniform(0, 1);
      for (double& v : y) v = random.uniform(0, 1);
      std::vector<std::uint8_t> got(50), want(50);
      scene.contains({&pixel, 1}, x, y, got);
      list.contains({&pixel, 1}, x, y, want);
      const Vec2 lo{random.uniform(0, 1), random.uniform(0, 1)};
      const Rect r{lo, {lo.x + random.log_uniform(1e-3, 1), lo.y + random.log_uniform(1e-3, 1)}};
      Boundary got_boundary, want_boundary;
      scene.boundary(pixel, 2, got_boundary);
      list.boundary(pixel, 2, want_boundary);
      wrong += got != want;
      wrong += scene.cover(pixel, r) != list.cover(pixel, r);
      wrong += got_boundary.circles.size() != want_boundary.circles.size();
    }
    CHECK(wrong == 0);
  }

  TEST_CASE("stored numbers given back make the same noise field, and one number is a radius for all") {
    const TestImage scene = field({{"seed", scenes::one(77)}});
    Given given;
    for (const auto& [name, numbers] : scene.stored()) {
      given.emplace_back(name, numbers.size() == 1 ? scenes::one(numbers[0]) : scenes::list(numbers));
    }
    const TestImage again = field(given);
    CHECK(again.stored() == scene.stored());
    Boundary a, b;
    scene.boundary({30, 30}, 16, a);
    again.boundary({30, 30}, 16, b);
    REQUIRE(a.circles.size() == b.circles.size());
    for (std::size_t i = 0; i < a.circles.size(); ++i) CHECK(a.circles[i].center == b.circles[i].center);
    CHECK(field({{"radius", scenes::one(0.25)}}).stored()[1].second == std::vector<double>{0.25, 0.25});
  }

  TEST_CASE("disks of a noise field are as many in every part of the image, and other seeds move them") {
    const Grid grid{256, 256};
    std::vector<std::int64_t> counts(64);
    for (const std::uint64_t seed : {1u, 2u}) {
      for (const GivenCircle& d : usual_disks(grid, seed)) {
        if (d.center.x < 0 || d.center.x >= 256 || d.center.y < 0 || d.center.y >= 256) continue;
        ++counts[static_cast<std::size_t>(d.center.y / 32) * 8 + static_cast<std::size_t>(d.center.x / 32)];
      }
    }
    double mean = 0, chi = 0;
    for (const auto n : counts) mean += static_cast<double>(n) / 64;
    for (const auto n : counts) chi += (static_cast<double>(n) - mean) * (static_cast<double>(n) - mean) / mean;
    CHECK(mean == doctest::Approx(2 * 1.2 * 32 * 32).epsilon(0.01));  // 157,000 disks: 0.25% at one standard deviation
    // Disks keep apart, so that counts vary less than Poisson's: only too large a chi-square is a fault.
    CHECK(chi < 63 + 4 * std::sqrt(2 * 63.0));
    const auto one = usual_disks({64, 64}, 1), two = usual_disks({64, 64}, 2);
    int same = 0;
    for (std::size_t i = 0; i < one.size(); ++i) same += one[i].center == two[i].center;
    CHECK(same == 0);
  }

  TEST_CASE("a noise field that cannot be is refused where it stands, with what would be right") {
    using scenes::list, scenes::one;
    const std::string many = refusal({{"count", one(65000)}});
    CHECK(many ==
          "s.toml:4:9: 65000 disks of radius 0.2 to 0.3 are too many for the 36864 square pixels of the image and 64 "
          "pixels around it (1.763 a pixel); at most 64846 (1.759 a pixel)");
    CHECK(refusal({{"count", one(static_cast<double>(most_noise_disks(0.2, 0.3, {64, 64})))}}).empty());
    CHECK(says(refusal({{"count", one(0)}}), "\"count\" must be a whole number of disks, 1 to"));
    CHECK(says(refusal({{"count", one(2.5)}}), "whole number"));
    CHECK(says(refusal({{"count", list({1, 2})}}), "whole number"));
    for (const auto& radius : {list({}), list({0.1, 0.2, 0.3}), scenes::rows({0.1, 0.2}, 2)}) {
      CHECK(refusal({{"radius", radius}}) ==
            "s.toml:4:9: \"radius\" must be one number or [smallest, largest], in pixels");
    }
    for (const auto& radius : {one(0), one(-1), list({0.3, 0.2}), one(8.5), one(1e-7)}) {
      CHECK(says(refusal({{"radius", radius}}), "give 1e-06 <= smallest <= largest <= 8 pixels"));
    }
    CHECK(says(refusal({{"radius", list({0.1, std::numeric_limits<double>::quiet_NaN()})}}), "not finite"));
    CHECK(says(refusal({{"seed", one(-1)}}), "seed"));
    // The usual count of an image of 8192 x 8192 pixels is above what is held.
    CHECK(says(refusal({}, {8192, 8192}), "at most 8388608"));
  }
}
