// Strips: what a scene says about strips of a pixel holds for every point thrown at them, also next to where they
// change their mind; and the loops behind contains() give the same bits with every instruction set.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "scenes.h"
#include "testimages/point_signs.h"
#include "testimages/testimage.h"

using namespace moire;

namespace {

double steps_from(double v, int ulps) {
  for (int i = 0; i < std::abs(ulps); ++i) v = std::nextafter(v, ulps > 0 ? HUGE_VAL : -HUGE_VAL);
  return v;
}

struct StripArrays {
  explicit StripArrays(std::size_t count) : numbers(4 * count), size(count) {}
  std::vector<double> numbers;
  std::size_t size;
  Strips strips() {
    const std::span<double> all(numbers);
    return {all.first(size), all.subspan(size, size), all.subspan(2 * size, size), all.subspan(3 * size)};
  }
};

// Points of the strips of a pixel that are not what was promised. Points are on the strips' sides and within, at random
// x and up to 3 ulp to both sides of where a promise begins or ends. Adds the length in x of what is left open, summed
// over the strips.
int broken_promises(const TestImage& scene, Pixel pixel, const std::vector<double>& sides, std::mt19937_64& random,
                    double& open) {
  StripArrays arrays(sides.size() - 1);
  const Strips s = arrays.strips();
  if (!scene.strips(pixel, sides, s)) return 0;
  std::uniform_real_distribution<double> unit(0, 1);
  int broken = 0;
  for (std::size_t j = 0; j < arrays.size; ++j) {
    const double begin = std::clamp(s.outer_begin[j], 0.0, 1.0), end = std::clamp(s.outer_end[j], 0.0, 1.0);
    const double from = std::clamp(s.inner_begin[j], 0.0, 1.0), to = std::clamp(s.inner_end[j], 0.0, 1.0);
    open += std::max(0.0, end - begin) - std::max(0.0, to - from);
    std::vector<double> x, y;
    const double height = sides[j + 1] - sides[j];
    for (const double v :
         {sides[j], sides[j + 1], sides[j] + height * unit(random), sides[j] + height * unit(random)}) {
      for (const double at : {s.outer_begin[j], s.outer_end[j], s.inner_begin[j], s.inner_end[j]}) {
        for (int ulps = -3; ulps <= 3; ++ulps) {
          const double p = steps_from(at, ulps);
          if (p >= 0 && p <= 1) {
            x.push_back(p);
            y.push_back(v);
          }
        }
      }
      for (const double p : {0.0, 1.0, unit(random), unit(random), unit(random)}) {
        x.push_back(p);
        y.push_back(v);
      }
    }
    std::vector<std::uint8_t> inside(x.size());
    scene.contains({&pixel, 1}, x, y, inside);
    for (std::size_t i = 0; i < x.size(); ++i) {
      if (x[i] < s.outer_begin[j] || x[i] > s.outer_end[j]) broken += inside[i] != 0;
      if (x[i] >= s.inner_begin[j] && x[i] <= s.inner_end[j]) broken += inside[i] == 0;
    }
    broken += std::isnan(s.outer_begin[j]) || std::isnan(s.outer_end[j]) || std::isnan(s.inner_begin[j]) ||
              std::isnan(s.inner_end[j]);
  }
  return broken;
}

std::vector<double> equal_sides(int rows) {
  std::vector<double> sides;
  for (int j = 0; j <= rows; ++j) sides.push_back(j / static_cast<double>(rows));
  return sides;
}

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("strips never lie: random edges and disks of all sizes, near and far, whose boundary is in the pixel") {
    std::mt19937_64 random(11);
    std::uniform_real_distribution<double> unit(0, 1), angle(0, 360);
    int broken = 0;
    for (int i = 0; i < 3000; ++i) {
      // A point of the boundary inside the pixel, now and then on a lattice of 1/16.
      const bool round = i % 3 == 0;
      const auto place = [&] { return round ? std::floor(unit(random) * 16) / 16 : unit(random); };
      const Pixel pixel{i % 5 == 0 ? (std::int64_t{1} << 33) + 1 : 3, i % 7 == 0 ? -(std::int64_t{1} << 35) : 2};
      const Vec2 on{static_cast<double>(pixel.x) + place(), static_cast<double>(pixel.y) + place()};
      const std::vector<double> sides = equal_sides(1 + i % 40);
      double open = 0;
      const double degrees = i % 4 == 0 ? std::floor(angle(random) / 45) * 45 : angle(random);
      broken += broken_promises(scenes::edge(on, degrees), pixel, sides, random, open);
      const double turn = degrees * 3.14159265358979 / 180;
      broken += broken_promises(scenes::edge(on, {std::pow(2.0, -60 * unit(random)), 1}), pixel, sides, random, open);
      const double radius = std::pow(10.0, -6 + 18 * unit(random));
      const Vec2 centre{on.x + radius * std::cos(turn), on.y + radius * std::sin(turn)};
      const TestImage disk = scenes::disk(centre, radius);
      broken += broken_promises(disk, pixel, sides, random, open);
      broken += broken_promises(scenes::disks({centre.x, centre.y, radius}), pixel, sides, random, open);
    }
    CHECK(broken == 0);
  }

  TEST_CASE("strips leave open little more than what the boundary covers") {
    // Over all strips a boundary that crosses a strip once leaves open what it runs along x, the whole pixel's width at
    // most for a line, and twice that for a circle's two halves.
    std::mt19937_64 random(12);
    for (const double degrees : {0.0, 3.0, 45.0, 88.0, 97.3, 180.0, 271.0}) {
      double open = 0;
      broken_promises(scenes::edge({3.4, 2.6}, degrees), {3, 2}, equal_sides(64), random, open);
      CHECK(open <= 1 + 1e-9);
    }
    for (const double radius : {0.01, 0.3, 5.0, 2000.0, 1e6}) {
      for (const Vec2 towards : {Vec2{1, 0}, Vec2{0, -1}, Vec2{0.6, 0.8}, Vec2{-0.8, 0.6}}) {
        double open = 0;
        const Vec2 centre{3.4 + radius * towards.x, 2.6 + radius * towards.y};
        broken_promises(scenes::disk(centre, radius), {3, 2}, equal_sides(64), random, open);
        // At 10^6 pixels a rounding of R^2 moves the circle's side by 1e-10, and its top by 1e-5 sideways.
        CHECK(open <= 2 + 1e-3);
      }
    }
  }

  TEST_CASE("a pixel near two disks has no strips, one without any has empty ones") {
    const TestImage two = scenes::disks({3.2, 2.5, 0.1, 3.8, 2.5, 0.1});
    const std::vector<double> sides = equal_sides(8);
    StripArrays arrays(8);
    CHECK_FALSE(two.strips({3, 2}, sides, arrays.strips()));
    REQUIRE(two.strips({5, 2}, sides, arrays.strips()));
    for (std::size_t j = 0; j < 8; ++j) {
      CHECK(arrays.strips().outer_begin[j] > arrays.strips().outer_end[j]);
      CHECK(arrays.strips().inner_begin[j] > arrays.strips().inner_end[j]);
    }
  }

  TEST_CASE("signs of many points are the same with every instruction set, for odd lengths, too") {
    std::mt19937_64 random(13);
    std::uniform_real_distribution<double> unit(0, 1);
    std::vector<double> x(300), y(300);
    for (double& v : x) v = unit(random);
    for (double& v : y) v = unit(random);
    for (const std::size_t n : {0u, 1u, 3u, 7u, 8u, 15u, 16u, 17u, 63u, 64u, 65u, 299u}) {
      CAPTURE(n);
      const std::span<const double> px(x.data(), n), py(y.data(), n);
      for (const double doubt : {0.0, 1e-3, 10.0}) {
        const LineSign line{{0.3, -0.8}, -0.2, doubt};
        const CircleSign circle{{0.9, 1.1}, -0.4, doubt};
        bool doubtful_line = false, doubtful_circle = false;
        std::vector<std::uint8_t> above(n), within(n);
        for (std::size_t i = 0; i < n; ++i) {
          const double s = line.normal.x * x[i] + line.normal.y * y[i] - line.offset;
          const double e = x[i] * (x[i] - circle.twice_center.x) + y[i] * (y[i] - circle.twice_center.y) - circle.power;
          above[i] = s >= 0;
          within[i] = i % 5 == 0 || e < -doubt;
          doubtful_line |= std::fabs(s) <= doubt;
          doubtful_circle |= std::fabs(e) <= doubt;
        }
        for (const SignLoops& loops : sign_loops()) {
          std::vector<std::uint8_t> inside(n + 1, 7);
          CHECK(loops.mark_above(line, px, py, inside.data()) == doubtful_line);
          CHECK(std::equal(above.begin(), above.end(), inside.begin()));
          CHECK(inside[n] == 7);
          for (std::size_t i = 0; i < n; ++i) inside[i] = i % 5 == 0;
          CHECK(loops.mark_within(circle, px, py, inside.data()) == doubtful_circle);
          CHECK(std::equal(within.begin(), within.end(), inside.begin()));
          CHECK(inside[n] == 7);
        }
      }
    }
  }

  TEST_CASE("points of a board are marked alike by every instruction set, and as one by one") {
    // A quarter of the points behind the camera, some near lines, and W = 0 at x = 0.25.
    std::mt19937_64 random(5);
    const auto unit = [](std::mt19937_64& r) { return static_cast<double>(r() >> 11) * 0x1p-53; };
    std::vector<double> x(299), y(299);
    for (double& v : x) v = unit(random);
    for (double& v : y) v = unit(random);
    for (std::size_t i = 0; i < x.size(); i += 7) x[i] = 0.25;
    for (std::size_t i = 3; i < y.size(); i += 7) y[i] = std::floor(8 * y[i]) / 8;
    for (const double error : {0x1p-60, 1e-3, 10.0}) {
      for (const double extent : {HUGE_VAL, 3.0}) {
        const BoardSign board{
            {2.5, 7, -3, error}, {0, 8, 0, error}, {4, 0, -1, error}, -extent, extent, -extent, extent};
        std::vector<std::uint8_t> expected(x.size());
        for (std::size_t i = 0; i < x.size(); ++i) {
          const auto at = [&](const BoardSign::Row& r) { return r.a * x[i] + r.b * y[i] + r.c; };
          const double w = at(board.w), r = 1 / w, u = at(board.u) * r, v = at(board.v) * r;
          const auto clear = [&](double q) {
            const double doubt = quotient_error(q, error, error, r), part = q - std::floor(q);
            return part > doubt && 1 - part > doubt && q > -extent + doubt && q < extent - doubt;
          };
          if (w < -error) continue;
          const bool even = std::fmod(std::floor(u) + std::floor(v), 2) == 0;
          expected[i] = w > 4 * error && clear(u) && clear(v) ? even : kDoubtful;
        }
        for (const std::size_t n : {0u, 1u, 3u, 7u, 8u, 15u, 16u, 17u, 63u, 64u, 65u, 299u}) {
          const bool doubtful = std::find(expected.begin(), expected.begin() + static_cast<std::ptrdiff_t>(n),
                                          kDoubtful) != expected.begin() + static_cast<std::ptrdiff_t>(n);
          for (const SignLoops& loops : sign_loops()) {
            std::vector<std::uint8_t> inside(n + 1, 7);
            CHECK(loops.mark_squares(board, {x.data(), n}, {y.data(), n}, inside.data()) == doubtful);
            CHECK(std::equal(inside.begin(), inside.end() - 1, expected.begin()));
            CHECK(inside[n] == 7);
          }
        }
        // With an error of 10 nothing is clear.
        CHECK((std::count(expected.begin(), expected.end(), std::uint8_t{0}) > 0) == (error < 10));
        CHECK(std::count(expected.begin(), expected.end(), kDoubtful) > 0);
      }
    }
  }
}
