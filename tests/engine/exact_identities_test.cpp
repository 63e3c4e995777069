// Exact values against identities that hold whatever the method: totals, complements, mirrors, halves.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <numbers>
#include <string>
#include <vector>

#include "engine/exact.h"
#include "engine/random_scenes.h"
#include "filter_list.h"
#include "oracle/scene.h"

namespace moire {
namespace {

std::vector<Filter> every_filter() {
  std::vector<Filter> all;
  for (const std::string& text : test::filter_texts()) all.emplace_back(parse_spec(text, "test"));
  return all;
}

// max |sum over integers j of k(x + j) - 1|: zero for a partition of unity.
double ripple(const Kernel& k) {
  const int reach = static_cast<int>(std::ceil(k.radius())) + 1;
  double worst = 0;
  for (int phase = 0; phase < 64; ++phase) {
    double sum = 0;
    for (int j = -reach; j <= reach; ++j) sum += k.k((phase + 0.5) / 64 + j);
    worst = std::max(worst, std::fabs(sum - 1));
  }
  return worst;
}

// Filters that are partitions of unity by theory: splines, what reproduces constants by interpolation, cosine sums of
// integer width. New ones are tested, too, and need not be here.
constexpr const char* kPartitions[] = {"box",
                                       "box:width=2",
                                       "tent",
                                       "tent:preset=pbrt",
                                       "bspline",
                                       "bspline:order=0",
                                       "bspline:order=2",
                                       "bspline:order=5",
                                       "mitchell",
                                       "mitchell:b=0.5,c=0.25",
                                       "catmull-rom",
                                       "hermite",
                                       "notch",
                                       "robidoux",
                                       "robidoux-sharp",
                                       "keys",
                                       "keys:a=-0.9",
                                       "simon",
                                       "rifman",
                                       "lagrange",
                                       "lagrange:order=2",
                                       "lagrange:order=7",
                                       "o-moms",
                                       "cubic-spline",
                                       "cubic-spline:lobes=3",
                                       "cubic-spline:lobes=4",
                                       "magic-kernel-sharp",
                                       "magic-kernel-sharp:version=2013",
                                       "blackman-harris"};

// Sum over all pixels of an image that holds the whole disk with its windows. The sum itself is exact to 1e-18.
long double total(const TestImage& scene, const Filter& filter) {
  const ActiveRows rows = enumerate(scene, filter.radius());
  const Reference reference = exact(scene, filter, rows);
  long double sum = 0;
  for (const double v : reference.value) sum += static_cast<long double>(v);
  for (int y = 0; y < rows.grid().height; ++y)
    for (const Run& run : rows.row(y))
      if (run.cover == Cover::all) sum += static_cast<long double>(run.x1 - run.x0);
  return sum;
}

// Relative error of the total of a disk at `offset` in the grid's cell.
double total_error(double radius, Vec2 offset, const Filter& filter) {
  const int margin = static_cast<int>(std::ceil(radius + filter.radius())) + 2, side = 2 * margin + 1;
  const TestImage disk = scenes::disk({margin + offset.x, margin + offset.y}, radius, {side, side});
  const auto r = static_cast<long double>(radius);
  const long double area = std::numbers::pi_v<long double> * r * r;
  return static_cast<double>(std::fabs(total(disk, filter) / area - 1));
}

constexpr Vec2 kOffsets[] = {{0.5, 0.5}, {0, 0}, {0.3, 0.8}, {0.5, 0.25}};
// The promise of moire for totals.
constexpr double kTotal = 1e-13;

// Two exact values that should be equal, each within its own bound.
void check_equal(Exact a, double truth, Exact b = {}) {
  const double error = std::fabs(a.value - truth - b.value);
  if (!(error <= a.bound + b.bound + 0x1p-52)) {  // the subtraction rounds too, values are below 2
    INFO(std::setprecision(17) << a.value << " +- " << a.bound << " against " << truth << " + " << b.value << " +- "
                               << b.bound);
    CHECK(error <= a.bound + b.bound + 0x1p-52);
  }
}

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("the pixels of a small disk sum to its area, radius 1e-6 to 0.1") {
    for (const Filter& filter : every_filter()) {
      if (filter.is_radial() || ripple(filter.kernel()) > 1e-14) continue;
      CAPTURE(filter.text());
      for (const double radius : {1e-6, 3e-6, 1e-5, 1e-4, 1e-3, 0.01, 0.03, 0.0999})
        for (const Vec2 offset : kOffsets) {
          CAPTURE(radius);
          CHECK(total_error(radius, offset, filter) <= kTotal);
        }
    }
  }

  // Circles smaller than an ulp of their place, and circles whose corner between quarters, at 45 degrees, or whose
  // extreme point lies within a few ulp of a pixel's side: pieces shorter than an ulp must go to the pixel that they
  // are in. The first such circle, radius 4e-8 at (0.99999997298, -1.000000028), was off by 8e-10 of its area in all.
  TEST_CASE("tiny disks whose special points meet pixel sides sum to their area, radius 1e-20 to 0.06") {
    for (const char* text : {"box", "box:width=3", "tent", "mitchell"}) {
      const Filter filter(parse_spec(text, "test"));
      CAPTURE(text);
      for (const double radius : {1e-20, 1e-12, 3.96238809685344e-08, 6e-7, 7e-5, 5e-4, 0.01, 0.06}) {
        CAPTURE(radius);
        for (const double share : {std::sqrt(0.5), 1.0, 0.0}) {
          for (int ulps = -4; ulps <= 4; ++ulps) {
            double x = 1 - radius * share, y = -1 - radius * share;
            for (int i = 0; i < std::abs(ulps); ++i) x = std::nextafter(x, ulps < 0 ? -9.0 : 9.0);
            CHECK(total_error(radius, {x, y}, filter) <= kTotal);
          }
        }
      }
    }
    // Half of it to either side, by symmetry, though no double tells the halves apart.
    const Filter box(parse_spec("box", "test"));
    const TestImage speck = scenes::disk({10.5, 11.0}, 1e-20);
    const double half = 0.5 * 3.14159265358979323846 * 1e-40;
    CHECK(std::fabs(exact_pixel(speck, box, {10, 10}).value / half - 1) <= kTotal);
    CHECK(std::fabs(exact_pixel(speck, box, {10, 11}).value / half - 1) <= kTotal);
  }

  TEST_CASE("a mirrored or transposed scene gives the mirrored or transposed values") {
    Draw draw(21);
    for (const Filter& filter : every_filter()) {
      CAPTURE(filter.text());
      for (int i = 0; i < 40; ++i) {
        // Dyadic coordinates: mirroring them is exact.
        const auto dyadic = [&](double lo, double hi) { return std::round(draw.uniform(lo, hi) * 0x1p20) * 0x1p-20; };
        const Vec2 p{dyadic(-2, 3), dyadic(-2, 3)}, n{dyadic(-1, 1), dyadic(-1, 1) + 0x1p-30};
        const double r = dyadic(0.01, 20);
        const Pixel at{0, 0}, mirrored{-1, 0};
        const Exact edge = exact_pixel(scenes::edge(p, n), filter, at);
        check_equal(edge, 0, exact_pixel(scenes::edge({-p.x, p.y}, {-n.x, n.y}), filter, mirrored));
        check_equal(edge, 0, exact_pixel(scenes::edge({p.y, p.x}, {n.y, n.x}), filter, at));
        // A 3-4-5 triangle from p to the centre: the circle passes through p, with all numbers exact up to radius 5e8.
        const double m = i % 2 == 0 ? r / 4 : std::round(draw.log_uniform(1, 1e8));
        const Vec2 c{p.x + (draw.coin() ? 3 : -3) * m, p.y + (draw.coin() ? 4 : -4) * m};
        const Exact disk = exact_pixel(scenes::disk(c, 5 * m), filter, at);
        check_equal(disk, 0, exact_pixel(scenes::disk({-c.x, c.y}, 5 * m), filter, mirrored));
        check_equal(disk, 0, exact_pixel(scenes::disk({c.x, 1 - c.y}, 5 * m), filter, at));
        check_equal(disk, 0, exact_pixel(scenes::disk({c.y, c.x}, 5 * m), filter, at));
        const double a = dyadic(-0.5, 0.5), b = dyadic(-0.5, 0.5) + 0x1p-25, g = dyadic(-0.01, 0.01);
        const std::vector<double> extent{-3, 4, -2.5, 3};
        const Exact board = exact_pixel(scenes::board({a, b, 0.25, -b, a, 0.5, g, 0.001, 1}, extent), filter, at);
        check_equal(board, 0,
                    exact_pixel(scenes::board({-a, b, 0.25, b, a, 0.5, -g, 0.001, 1}, extent), filter, mirrored));
        check_equal(board, 0, exact_pixel(scenes::board({b, a, 0.25, a, -b, 0.5, 0.001, g, 1}, extent), filter, at));
      }
    }
  }

  TEST_CASE("an edge and its complement sum to 1, and an edge through a pixel's centre gives 1/2") {
    Draw draw(22);
    for (const Filter& filter : every_filter()) {
      CAPTURE(filter.text());
      for (int i = 0; i < 100; ++i) {
        const RandomCase c = random_edge(draw, filter.radius());
        const oracle::Edge e = oracle::edge_of(c.image);
        const Vec2 through{e.through[0], e.through[1]}, normal{e.normal[0], e.normal[1]};
        const Exact edge = exact_pixel(scenes::edge(through, normal), filter, c.pixel);
        const Exact other = exact_pixel(scenes::edge(through, {-normal.x, -normal.y}), filter, c.pixel);
        check_equal(edge, 1, {-other.value, other.bound});
        const Vec2 centre{static_cast<double>(c.pixel.x) + 0.5, static_cast<double>(c.pixel.y) + 0.5};
        check_equal(exact_pixel(scenes::edge(centre, normal), filter, c.pixel), 0.5);
      }
    }
  }

  TEST_CASE("pixels whose windows miss the boundary are exactly 0 or 1 with bound 0") {
    for (const Filter& filter : every_filter()) {
      CAPTURE(filter.text());
      const double gap = filter.radius() + 1e-3;  // more than the growth of active windows, 2^-20
      const auto check_flat = [&](const TestImage& scene, double truth) {
        const Exact e = exact_pixel(scene, filter, {7, -3});
        CHECK(e.value == truth);
        CHECK_FALSE(std::signbit(e.value));
        CHECK(e.bound == 0);
      };
      const Vec2 centre{7.5, -2.5};
      for (const double s : {-1.0, 1.0}) {
        check_flat(scenes::edge({centre.x + s * gap, 0}, {s, 0}), 0);
        check_flat(scenes::edge({centre.x + s * gap, 0}, {-s, 0}), 1);
        check_flat(scenes::disk({centre.x + s * (gap + 40), centre.y}, 40), 0);
      }
      check_flat(scenes::disk(centre, std::sqrt(2.0) * gap), 1);
      // Squares of 16 pixels: (0, 0) is white, (1, 0) black; the board ends at v = 1.
      const auto squares = [&](double u, double v) {
        return scenes::board({1.0 / 16, 0, u - centre.x / 16, 0, 1.0 / 16, v - centre.y / 16, 0, 0, 1}, {0, 8, 0, 1});
      };
      check_flat(squares(0.5, 0.5), 1);
      check_flat(squares(1.5, 0.5), 0);
      check_flat(squares(0.5, 1 + gap / 16), 0);
    }
  }

  TEST_CASE("white squares and black squares make the whole board") {
    // The black squares are the board moved by one square in u; homography and rim are exact in double.
    const double a = 0.375, b = 0.125, c = 0.75, g = 0x1p-6;
    const auto homography = [&](double shift) {
      return std::vector<double>{a + shift * g, b + shift * g, c + shift, -b, a, 0.5, g, g, 1};
    };
    // The whole board is one square of a plane scaled down by 8: u from 0 to 8 there, v likewise.
    const std::vector<double> scaled{a / 8, b / 8, c / 8, -b / 8, a / 8, 0.5 / 8, g, g, 1};
    for (const Filter& filter : every_filter()) {
      CAPTURE(filter.text());
      for (int y = -4; y < 24; y += 3)
        for (int x = -4; x < 24; ++x) {
          const Exact white = exact_pixel(scenes::board(homography(0), {0, 8, 0, 8}), filter, {x, y});
          const Exact black = exact_pixel(scenes::board(homography(1), {1, 9, 0, 8}), filter, {x, y});
          const Exact whole = exact_pixel(scenes::board(scaled, {0, 1, 0, 1}), filter, {x, y});
          check_equal({white.value + black.value, white.bound + black.bound}, 0, whole);
        }
    }
  }
}

TEST_SUITE("heavy") {
  TEST_CASE("the pixels of a disk sum to its area for filters that are partitions of unity, radius 0.1 to 300") {
    std::vector<std::string> met;
    for (const Filter& filter : every_filter()) {
      if (filter.is_radial() || ripple(filter.kernel()) > 1e-14) continue;
      met.push_back(filter.text());
      CAPTURE(filter.text());
      for (const double radius : {0.1, 0.25, 0.31, 0.5, 1.0, 3.3, 17.7, 100.0, 300.0})
        for (const Vec2 offset : kOffsets) {
          CAPTURE(radius);
          CHECK(total_error(radius, offset, filter) <= kTotal);
        }
    }
    for (const std::string text : kPartitions) {
      CAPTURE(text);
      CHECK(std::find(met.begin(), met.end(), text) != met.end());
    }
  }

  TEST_CASE("the values of an image are those of its pixels, bit for bit, and its bound is their largest") {
    const TestImage scenes_of_all_kinds[] = {
        scenes::edge({20.3, 31.7}, {0.6, -0.7}, {48, 40}), scenes::disk({22.1, 18.4}, 13.7, {48, 40}),
        scenes::board({.focal = 30, .principal = {24, 10}, .pitch = 25, .yaw = 20, .roll = 5}, {-2, 3, 1, 6},
                      {48, 40})};
    for (const Filter& filter : every_filter())
      for (const TestImage& scene : scenes_of_all_kinds) {
        CAPTURE(filter.text());
        const ActiveRows rows = enumerate(scene, filter.radius());
        const Reference image = exact(scene, filter, rows);
        REQUIRE(image.value.size() == static_cast<std::size_t>(rows.active_pixels()));
        REQUIRE(image.bound.size() == image.value.size());
        double largest = 0;
        int different = 0;
        for_each_active(rows, [&](std::int32_t x, std::int32_t y, std::int64_t index) {
          const Exact e = exact_pixel(scene, filter, {x, y});
          const auto i = static_cast<std::size_t>(index);
          if (e.value != image.value[i] || e.bound != image.bound[i]) ++different;
          largest = std::max(largest, e.bound);
        });
        CHECK(different == 0);
        CHECK(image.max_bound == largest);
      }
  }
}

}  // namespace moire
