// Time-averaged pixel values: against the still engine integrated over time, against identities.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numbers>
#include <string>
#include <vector>

#include "core/error.h"
#include "core/sum.h"
#include "engine/random_scenes.h"
#include "engine/time_average.h"
#include "filter_list.h"
#include "reports/folder.h"

namespace moire {
namespace {

using test::MovingShape;

constexpr double kTolerance = 1e-11;    // what moire promises for motions of some pixels
constexpr double kMedianBound = 1e-13;  // per filter, of the bounds of motions up to 10 pixels

// A shape whose boundary is in the pixel's window at some time; motions of `least` to `most` pixels, some of them along
// an axis or nearly so, some along the boundary.
MovingShape random_shape(Draw& draw, Pixel pixel, double reach, double least, double most) {
  const double length = draw.log_uniform(least, most), angle = draw.uniform(0, 2 * std::numbers::pi);
  MovingShape s;
  s.motion = {length * std::cos(angle), length * std::sin(angle)};
  const std::int64_t way = draw.integer(0, 11);
  if (way == 0) s.motion.x = 0;
  if (way == 1) s.motion.y = 0;
  if (way == 2) s.motion.x *= draw.log_uniform(1e-6, 1);
  if (way == 3) s.motion.y *= draw.log_uniform(1e-6, 1);
  const double normal = draw.coin() ? draw.uniform(0, 2 * std::numbers::pi)
                                    : angle + static_cast<double>(draw.integer(0, 3)) * std::numbers::pi / 2;
  const Vec2 n{std::cos(normal), std::sin(normal)};
  const Vec2 on = point_in_window(draw, pixel, reach);
  const double when = draw.uniform(0, 1);
  s.at = {on.x - when * s.motion.x, on.y - when * s.motion.y};
  if (draw.coin()) {
    s.normal = n;
  } else {
    s.radius = draw.log_uniform(1e-3, 300);
    s.at = {s.at.x - s.radius * n.x, s.at.y - s.radius * n.y};
  }
  return s;
}

// Everything in quarters of a pixel: paths through the knots' corners, boundaries that touch and lie on lines, several
// of these at once.
MovingShape shape_on_lattice(Draw& draw) {
  const auto quarter = [&](std::int64_t lo, std::int64_t hi) {
    return static_cast<double>(draw.integer(4 * lo, 4 * hi)) / 4;
  };
  MovingShape s;
  do s.motion = {quarter(-3, 3), quarter(-3, 3)};
  while (s.motion == Vec2{});
  s.at = {quarter(-4, 4), quarter(-4, 4)};
  if (draw.coin()) {
    s.radius = static_cast<double>(draw.integer(1, 16)) / 4;
  } else {
    do s.normal = {quarter(-1, 1), quarter(-1, 1)};
    while (s.normal == Vec2{});
  }
  return s;
}

struct Compared {
  std::vector<double> bounds;
  int partial = 0;

  void operator()(const MovingShape& s, const Filter& filter, Pixel pixel, double tolerance) {
    const Exact got = exact_pixel(s.image(), filter, pixel);
    const test::TimeAverage want = test::time_average(s, filter, pixel);
    const double error = std::fabs(got.value - want.value);
    CAPTURE(s.at.x);
    CAPTURE(s.at.y);
    CAPTURE(s.normal.x);
    CAPTURE(s.normal.y);
    CAPTURE(s.radius);
    CAPTURE(s.motion.x);
    CAPTURE(s.motion.y);
    CAPTURE(want.error);
    CHECK(error <= tolerance);
    CHECK(error <= got.bound + want.error);
    if (got.value != 0 && got.value != 1) {
      ++partial;
      bounds.push_back(got.bound);
    }
  }
  double median() {
    const auto middle = bounds.begin() + static_cast<std::ptrdiff_t>(bounds.size() / 2);
    std::nth_element(bounds.begin(), middle, bounds.end());
    return *middle;
  }
};

void compare(const std::string& text, int count, std::uint64_t seed) {
  CAPTURE(text);
  const Filter filter(parse_spec(text, "test"));
  Draw draw(seed);
  Compared compared;
  for (int i = 0; i < count; ++i) {
    const Pixel pixel{draw.integer(-5, 5), draw.integer(-5, 5)};
    compared(random_shape(draw, pixel, filter.radius(), 1e-3, 10), filter, pixel, kTolerance);
  }
  CHECK(compared.partial > count / 2);
  CHECK(compared.median() < kMedianBound);
  for (int i = 0; i < count; ++i) {
    compared(shape_on_lattice(draw), filter, {draw.integer(-3, 3), draw.integer(-3, 3)}, kTolerance);
  }
}

bool within(const Exact& a, const Exact& b, double more = 0) {
  return std::fabs(a.value - b.value) <= a.bound + b.bound + more;
}

MovingShape moved(MovingShape s, Vec2 by, Vec2 motion) {
  s.at = {s.at.x + by.x, s.at.y + by.y};
  s.motion = motion;
  return s;
}

// Coordinates in multiples of 2^-20, so that adding motions to them is exact.
MovingShape rounded(MovingShape s) {
  for (double* v : {&s.at.x, &s.at.y, &s.motion.x, &s.motion.y}) *v = std::round(*v * 0x1p20) * 0x1p-20;
  return s;
}

const std::vector<std::string>& some_filters() {
  static const std::vector<std::string> texts{"box", "tent", "mitchell", "gaussian", "box:width=2", "lanczos:a=2"};
  return texts;
}

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("a moving edge or disk has the mean over time of its still values") {
    for (const std::string& text : some_filters()) compare(text, 40, 71);
  }

  TEST_CASE("motions far below a pixel and far above the image are right within their bounds") {
    Draw draw(72);
    for (const std::string& text : some_filters()) {
      CAPTURE(text);
      const Filter filter(parse_spec(text, "test"));
      Compared compared;
      for (int i = 0; i < 30; ++i) {
        const Pixel pixel{draw.integer(-5, 5), draw.integer(-5, 5)};
        compared(random_shape(draw, pixel, filter.radius(), 1e-15, 1e-6), filter, pixel, kTolerance);
      }
      CHECK(compared.median() < kMedianBound);
      // Coordinates of 10^4 pixels are right to 10^-12, and so is the still engine's place at a time.
      Compared far;
      for (int i = 0; i < 30; ++i) {
        const Pixel pixel{draw.integer(-5, 5), draw.integer(-5, 5)};
        far(random_shape(draw, pixel, filter.radius(), 100, 1e4), filter, pixel, 1e-10);
      }
      CHECK(far.median() < 1e-11);
    }
  }

  TEST_CASE("backwards in time a scene has the same values, and twice the average is that of the halves") {
    Draw draw(73);
    for (const std::string& text : some_filters()) {
      CAPTURE(text);
      const Filter filter(parse_spec(text, "test"));
      for (int i = 0; i < 100; ++i) {
        const Pixel pixel{draw.integer(-5, 5), draw.integer(-5, 5)};
        MovingShape s = rounded(random_shape(draw, pixel, filter.radius(), 1e-3, 30));
        if (i % 4 == 0 && s.is_disk()) {  // a huge one, whose boundary passes the pixel's centre at time 0
          s.radius = std::round(draw.log_uniform(1e4, 1e9));
          s.at = {static_cast<double>(pixel.x) + 0.5 - s.radius, static_cast<double>(pixel.y) + 0.5};
        }
        const Vec2 d = s.motion, half{d.x / 2, d.y / 2};
        if (d == Vec2{}) continue;
        const auto value = [&](const MovingShape& m) { return exact_pixel(m.image(), filter, pixel); };
        const Exact whole = value(s), back = value(moved(s, d, {-d.x, -d.y}));
        CHECK(within(whole, back));
        const Exact first = value(moved(s, {}, half)), second = value(moved(s, half, half));
        const Exact mean{0.5 * (first.value + second.value), 0.5 * (first.bound + second.bound) + 0x1p-52};
        CHECK(within(whole, mean));
      }
    }
  }

  TEST_CASE("without motion, and for an edge that moves along itself, values are those of the still scene") {
    Draw draw(74);
    for (const std::string& text : some_filters()) {
      const Filter filter(parse_spec(text, "test"));
      for (int i = 0; i < 50; ++i) {
        const Pixel pixel{draw.integer(-5, 5), draw.integer(-5, 5)};
        MovingShape s = random_shape(draw, pixel, filter.radius(), 1, 10);
        const Exact still = exact_pixel(s.still(0), filter, pixel);
        s.motion = {};
        const Exact none = exact_pixel(s.image(), filter, pixel);
        CHECK(none.value == still.value);
        CHECK(none.bound == still.bound);
        if (s.is_disk()) continue;
        const double far = draw.log_uniform(1e-3, 1e5);
        s.motion = {-far * s.normal.y, far * s.normal.x};
        // Rounded, the motion is off the edge by an ulp of itself: as far as the edge itself may be.
        CHECK(within(exact_pixel(s.image(), filter, pixel), still, 8 * 0x1p-53 * far));
      }
    }
  }

  TEST_CASE("the values of all pixels add up to the disk's area") {
    for (const std::string& text : some_filters()) {
      CAPTURE(text);
      const Filter filter(parse_spec(text, "test"));
      // Kernels that are no partition of unity in each pixel's phase add up to something else.
      if (text == "gaussian" || text == "lanczos:a=2") continue;
      for (const double radius : {1e-3, 0.3, 5.75}) {
        for (const Vec2 motion : {Vec2{3.3, 7.1}, Vec2{0, 5}, Vec2{-8, 0}, Vec2{1e-3, -1e-4}, Vec2{4, 4}}) {
          const TestImage scene = scenes::moving_disk({16.2, 15.9}, radius, motion, {36, 36});
          const ActiveRows rows = enumerate(scene, filter.radius());
          const Reference reference = exact(scene, filter, rows);
          Sum sum, bound;
          for (std::size_t i = 0; i < reference.value.size(); ++i) {
            sum.add(reference.value[i]);
            bound.add(reference.bound[i]);
          }
          for (int y = 0; y < 36; ++y) {
            for (const Run& run : rows.row(y)) {
              if (run.cover == Cover::all) sum.add(run.x1 - run.x0);
            }
          }
          const double area = std::numbers::pi * radius * radius;
          CHECK(std::fabs(sum.value() - area) <= bound.value() + 4 * 0x1p-53 * area);
          CHECK(reference.max_bound < 1e-12);
        }
      }
    }
  }

  TEST_CASE("samples at random times agree with the exact average, for disks together") {
    Draw draw(75);
    const TestImage scene = scenes::moving_disks({4, 4, 1.5, 8, 5, 2, 5.5, 9, 0.75}, {3.5, -2.25}, {16, 16});
    const Filter box(parse_spec("box", "test"));
    const ActiveRows rows = enumerate(scene, box.radius());
    constexpr int kSamples = 4000;
    double squares = 0;
    int pixels = 0;
    for_each_active(rows, [&](int x, int y, std::int64_t) {
      const Pixel pixel{x, y};
      std::vector<double> px, py, t;
      for (int i = 0; i < kSamples; ++i) {
        px.push_back(draw.uniform(0, 1));
        py.push_back(draw.uniform(0, 1));
        t.push_back(draw.uniform(0, 1));
      }
      std::vector<std::uint8_t> in(kSamples);
      scene.contains_at({&pixel, 1}, px, py, t, in);
      const auto hits = static_cast<double>(std::count(in.begin(), in.end(), 1));
      const double v = exact_pixel(scene, box, pixel).value;
      if (v < 0.02 || v > 0.98) return;  // too few hits or misses for a normal law
      const double deviation = (hits / kSamples - v) / std::sqrt(v * (1 - v) / kSamples);
      squares += deviation * deviation;
      ++pixels;
    });
    // A chi-square of as many degrees of freedom: within 5 standard deviations, sqrt(2 / pixels) each.
    CHECK(pixels > 50);
    CHECK(std::fabs(squares / pixels - 1) < 5 * std::sqrt(2.0 / pixels));
  }

  TEST_CASE("kernels of more pieces than a moving scene takes are refused by name, and up to there they are done") {
    const Folder folder;
    for (const int rows : {33, 34}) {
      std::ofstream file(folder.file("table.csv"));
      for (int i = 0; i < rows; ++i) file << i / 32.0 << ',' << 1.25 - i / 32.0 + 0.01 * (i % 3) << '\n';
      file.close();
      const Filter filter(parse_spec("tabulated:path=" + folder.file("table.csv"), "test"));
      const TestImage scene = scenes::moving_disk({0.3, 0.2}, 0.4, {0.7, 0.2});
      if (rows == 33) {
        CHECK(filter.kernel().pieces() == 64);
        // Backwards in time, from where it arrives up to 2^-53: a value changes by little more than that.
        const TestImage back = scenes::moving_disk({1.0, 0.4}, 0.4, {-0.7, -0.2});
        const Exact a = exact_pixel(scene, filter, {0, 0}), b = exact_pixel(back, filter, {0, 0});
        CHECK(a.value > 0.1);
        CHECK(a.bound < 1e-12);
        CHECK(within(a, b, 1e-14));
        continue;
      }
      CHECK_THROWS_WITH_AS(exact_pixel(scene, filter, {0, 0}),
                           doctest::Contains("66 pieces; exact values of a moving scene take at most 64"), Error);
      CHECK(exact_pixel(scene, filter, {50, 50}).bound == 0);
    }
  }
}

TEST_SUITE("heavy") {
  TEST_CASE("moving edges and disks against the still engine over time, under every filter") {
    for (const std::string& text : test::separable_texts()) compare(text, 60, 81);
  }
}

}  // namespace moire
