// Exact values under radial filters: against the oracle's rings, closed forms and identities.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include "core/error.h"
#include "engine/exact.h"
#include "engine/exact_compare.h"
#include "engine/random_scenes.h"
#include "filter_list.h"
#include "oracle/rings.h"

namespace moire {
namespace {

// The goal for edges, disks and boards without end of detail.
constexpr double kGoal = 1e-12;
constexpr double kPi = std::numbers::pi;

class RadialComparison {
 public:
  explicit RadialComparison(const std::string& filter)
      : text_(filter), filter_(parse_spec(filter, "test")), kernel_(filter) {}

  double radius() const { return filter_.radius(); }
  const RadialKernel& kernel() const { return filter_.radial_kernel(); }

  // Checks |product - oracle| <= product's bound + oracle's error, and that the bound is what was aimed at.
  void operator()(const TestImage& image, Pixel pixel) {
    const Exact got = exact_pixel(image, filter_, pixel);
    const oracle::Value truth = oracle_value(image, pixel);
    const long double error = std::fabs(static_cast<long double>(got.value) - truth.value);
    INFO(describe_pixel(image, pixel, text_, got, truth));
    CHECK(error <= static_cast<long double>(got.bound) + truth.error);
    CHECK(truth.error < 1e-15L);
    CHECK(got.bound <= kGoal);
    worst_bound_ = std::max(worst_bound_, got.bound);
    worst_error_ = std::max(worst_error_, static_cast<double>(error));
  }

  std::string summary() const {
    std::ostringstream text;
    text << std::setprecision(2) << text_ << ": worst error " << worst_error_ << ", worst bound " << worst_bound_;
    return text.str();
  }

 private:
  oracle::Value oracle_value(const TestImage& image, Pixel pixel) const {
    const std::string_view kind = image.info().name;
    if (kind == "edge") return oracle::filtered(kernel_, oracle::edge_of(image), pixel);
    if (kind == "disk") return oracle::filtered(kernel_, oracle::disk_of(image), pixel);
    return oracle::filtered(kernel_, oracle::board_of(image), pixel);
  }

  std::string text_;
  Filter filter_;
  oracle::RingKernel kernel_;
  double worst_bound_ = 0, worst_error_ = 0;
};

// Distances that matter: none, knots of the kernel, a little beside them, and some between.
std::vector<double> hard_distances(const RadialKernel& kernel) {
  std::vector<double> all;
  for (const double knot : kernel.knots())
    for (const double beside : {0.0, 1e-15, -1e-15, 1e-9, -1e-5})
      if (knot + beside >= 0) all.push_back(knot + beside);
  for (const double d : {1e-300, 1e-12, 1e-7, 0.3}) all.push_back(d * kernel.radius());
  return all;
}

Exact at_origin(const TestImage& image, const Filter& filter) { return exact_pixel(image, filter, {0, 0}); }

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("random edges under radial filters are within their bounds of the oracle's rings") {
    for (const std::string& text : test::radial_texts()) {
      RadialComparison compare(text);
      Draw draw(41);
      for (int i = 0; i < 60; ++i) {
        const RandomCase c = random_edge(draw, compare.radius());
        compare(c.image, c.pixel);
      }
      MESSAGE(compare.summary());
    }
  }

  TEST_CASE("random disks of all sizes under radial filters are within their bounds of the oracle's rings") {
    for (const std::string& text : test::radial_texts()) {
      RadialComparison compare(text);
      Draw draw(42);
      for (int i = 0; i < 60; ++i) {
        const RandomCase c = random_disk(draw, compare.radius());
        compare(c.image, c.pixel);
      }
      MESSAGE(compare.summary());
    }
  }

  TEST_CASE("random finite boards under radial filters are within their bounds of the oracle's rings") {
    for (const std::string& text : test::radial_texts()) {
      RadialComparison compare(text);
      Draw draw(43);
      for (int i = 0; i < 6; ++i) {
        const RandomCase c = random_board(draw, compare.radius(), 12);
        compare(c.image, c.pixel);
      }
      MESSAGE(compare.summary());
    }
  }

  TEST_CASE("edges through the centre, along knot circles and the support's rim are within their bounds") {
    for (const std::string& text : test::radial_texts()) {
      RadialComparison compare(text);
      for (const double d : hard_distances(compare.kernel())) {
        for (const double degrees : {0.0, 90.0, 45.0, 180.0, 217.3}) {
          // Both sides of the centre; pixel (-1, -1) has its centre at (-1/2, -1/2) exactly.
          const double c = std::cos(degrees * kPi / 180), s = std::sin(degrees * kPi / 180);
          compare(scenes::edge({-0.5 + d * c, -0.5 + d * s}, degrees), {-1, -1});
          compare(scenes::edge({-0.5 - d * c, -0.5 - d * s}, degrees), {-1, -1});
        }
      }
      MESSAGE(compare.summary());
    }
  }

  TEST_CASE("disks that touch, surround or share the pixel's centre and knot circles are within their bounds") {
    for (const std::string& text : test::radial_texts()) {
      RadialComparison compare(text);
      Draw draw(44);
      for (const double d : hard_distances(compare.kernel())) {
        for (const double radius : {1e-12, 1e-4, 0.3, 3.0, 1e3, 1e12}) {
          const double angle = draw.uniform(0, 2 * kPi), c = std::cos(angle), s = std::sin(angle);
          // The disk's centre there; its rim there from outside and from inside.
          if (radius < 100) compare(scenes::disk({0.5 + d * c, 0.5 + d * s}, radius), {0, 0});
          compare(scenes::disk({0.5 + (radius + d) * c, 0.5 + (radius + d) * s}, radius), {0, 0});
          compare(scenes::disk({0.5 + (radius - d) * c, 0.5 + (radius - d) * s}, radius), {0, 0});
        }
        // The knot circle itself, and one just beside it that is not concentric.
        if (d > 1e-12) compare(scenes::disk({0.5, 0.5}, d), {0, 0});
        if (d > 1e-12) compare(scenes::disk({0.5 + 1e-13, 0.5}, d), {0, 0});
      }
      MESSAGE(compare.summary());
    }
  }

  TEST_CASE("tiny disks under radial filters are right relative to their size") {
    for (const std::string& text : test::radial_texts()) {
      CAPTURE(text);
      const Filter filter(parse_spec(text, "test"));
      const RadialKernel& kernel = filter.radial_kernel();
      const oracle::RingKernel truth(text);
      Draw draw(45);
      for (int i = 0; i < 40; ++i) {
        const double radius = draw.log_uniform(1e-12, kernel.radius() / 10), angle = draw.uniform(0, 2 * kPi);
        // Across a knot circle, or anywhere; the centre itself belongs to no tiny disk's formula.
        const double knot = kernel.knots()[static_cast<std::size_t>(draw.integer(0, kernel.pieces()))];
        const double across = knot + radius * draw.uniform(-1, 1), anywhere = draw.uniform(0, kernel.radius());
        const double away = std::max(2.01 * radius, i % 2 == 0 ? across : anywhere);
        const TestImage disk = scenes::disk({-0.5 + away * std::cos(angle), -0.5 + away * std::sin(angle)}, radius);
        const Exact got = exact_pixel(disk, filter, {-1, -1});
        const oracle::Value want = oracle::filtered_per_square(truth, oracle::disk_of(disk), {-1, -1});
        const auto square = static_cast<long double>(radius) * static_cast<long double>(radius);
        CAPTURE(radius);
        CAPTURE(away);
        CHECK(std::fabs(static_cast<long double>(got.value) / square - want.value) <=
              static_cast<long double>(got.bound) / square + want.error);
        // Some 250 roundings of the kernel's values and places around the circle, 2 pi 1.7
        // (engine/radial_offset.cpp: 1.7 = 9/8 of the way times far D / near^2).
        CHECK(got.bound <= 3000 * 0x1p-53 * kernel.k_max() * radius * radius);
      }
    }
  }

  TEST_CASE("the disk filter's edge is a circular segment and its disk a lens") {
    const Filter filter(parse_spec("disk:radius=1.25", "test"));
    const double r = 1.25, whole = kPi * r * r;
    for (int i = -12; i <= 12; ++i) {
      const double d = r * i / 12.5;  // of the edge, towards the inside
      const Exact edge = at_origin(scenes::edge({0.5 - d, 0.5}, 0.0), filter);
      const double segment = r * r * std::acos(-d / r) + d * std::sqrt(r * r - d * d);
      // Ten roundings of the formula, of a share below 1.
      CHECK(std::fabs(edge.value - segment / whole) <= edge.bound + 10 * 0x1p-53);
    }
    for (const double a : {0.25, 1.0, 1.25, 2.5, 7.0}) {
      for (double d = std::fabs(a - r) + 0.0625; d < a + r; d += 0.125) {
        const Exact disk = at_origin(scenes::disk({0.5 + d, 0.5}, a), filter);
        const double lens = r * r * std::acos((d * d + r * r - a * a) / (2 * d * r)) +
                            a * a * std::acos((d * d + a * a - r * r) / (2 * d * a)) -
                            0.5 * std::sqrt((-d + r + a) * (d + r - a) * (d - r + a) * (d + r + a));
        // Terms up to a^2 pi, and arc cosines that lose 1 / sin of their angle: ten bits here.
        CHECK(std::fabs(disk.value - lens / whole) <= disk.bound + 1e-13 * (1 + a * a));
      }
    }
  }

  TEST_CASE("the cone's concentric disks and its edge have their closed forms") {
    const Filter filter(parse_spec("cone:radius=2", "test"));
    for (const double a : {0.125, 0.5, 1.0, 1.75, 2.0}) {
      const double r = a / 2;
      const Exact disk = at_origin(scenes::disk({0.5, 0.5}, a), filter);
      CHECK(std::fabs(disk.value - (3 * r * r - 2 * r * r * r)) <= disk.bound + 4 * 0x1p-53);
    }
    for (int i = -9; i <= 9; ++i) {
      const double d = i / 10.0;  // of the edge over the radius
      const Exact edge = at_origin(scenes::edge({0.5 - 2 * d, 0.5}, 0.0), filter);
      // The integral of the chord's share: (3 / pi) of root - x^2 arcosh(1 / x) from there to 1, x the distance.
      const double x = std::fabs(d), root = std::sqrt(1 - x * x);
      const double cap =
          std::acos(x) / kPi - x * root * 2 / kPi + (x > 0 ? x * x * x / kPi * std::log((1 + root) / x) : 0.0);
      CHECK(std::fabs(edge.value - (d < 0 ? cap : 1 - cap)) <= edge.bound + 20 * 0x1p-53);
    }
  }

  TEST_CASE("an edge and its complement sum to 1 and turning it about the centre changes nothing") {
    for (const std::string& text : test::radial_texts()) {
      CAPTURE(text);
      const Filter filter(parse_spec(text, "test"));
      const double slope = 2 * filter.radius() * filter.radial_kernel().k_max();  // of the value by the edge's place
      Draw draw(46);
      for (int i = 0; i < 20; ++i) {
        const double d = draw.uniform(-1, 1) * filter.radius(), angle = draw.uniform(0, 2 * kPi);
        const Vec2 n{std::cos(angle), std::sin(angle)}, at{0.5 + d * n.x, 0.5 + d * n.y};
        const Exact one = at_origin(scenes::edge(at, n), filter),
                    other = at_origin(scenes::edge(at, {-n.x, -n.y}), filter);
        CHECK(std::fabs(one.value + other.value - 1) <= one.bound + other.bound + 0x1p-52);
        const Exact level = at_origin(scenes::edge({0.5 + d, 0.5}, 0.0), filter);
        // Points and normals rounded: some u of 1/2 + |d|.
        CHECK(std::fabs(one.value - level.value) <=
              one.bound + level.bound + slope * 8 * 0x1p-53 * (1 + filter.radius()));
      }
    }
  }

  TEST_CASE("the wide radial Gaussian is the separable one but for what lies beyond") {
    // Beyond 8 sigma exp(-32) < 2e-14 is left of either in all.
    const Filter radial(parse_spec("radial-gaussian:sigma=0.5,radius=4,cut=cut", "test")),
        separable(parse_spec("gaussian:sigma=0.5,radius=4,cut=cut", "test"));
    Draw draw(47);
    for (int i = 0; i < 100; ++i) {
      const RandomCase c = i % 2 == 0 ? random_edge(draw, 1.5) : random_disk(draw, 1.5);
      const Exact a = exact_pixel(c.image, radial, c.pixel), b = exact_pixel(c.image, separable, c.pixel);
      CHECK(std::fabs(a.value - b.value) <= a.bound + b.bound + 4e-14);
    }
  }

  TEST_CASE("the infinite board under radial filters is bounded, and away from the horizon bounded well") {
    const TestImage board = scenes::plane({.focal = 200, .principal = {32, 8}, .height = 3, .pitch = 10}, {64, 64});
    for (const char* text : {"disk", "cone", "radial-bc", "jinc"}) {
      CAPTURE(text);
      const Filter filter(parse_spec(text, "test"));
      const oracle::RingKernel truth(text);
      for (const Pixel p : {Pixel{30, 60}, Pixel{5, 50}, Pixel{61, 40}}) {
        const Exact got = exact_pixel(board, filter, p);
        const oracle::Value want = oracle::filtered(truth, oracle::board_of(board), p);
        CHECK(std::fabs(static_cast<long double>(got.value) - want.value) <=
              static_cast<long double>(got.bound) + want.error);
        CHECK(got.bound <= kGoal);
      }
    }
  }

  TEST_CASE("moving scenes refuse radial filters by name") {
    const TestImage disk(
        find_testimage("disk", ""),
        {{"center", scenes::list({8, 8})}, {"radius", scenes::one(3)}, {"motion", scenes::list({1, 0})}}, {16, 16},
        "test");
    try {
      exact_pixel(disk, Filter(parse_spec("jinc", "s.toml:4:12")), {5, 8});
      FAIL("not refused");
    } catch (const Error& e) {
      const std::string message = e.what();
      CHECK(
          message.starts_with("s.toml:4:12: filter \"jinc\" is radial, and a moving scene's exact values are known "
                              "for separable filters only; choose from box, "));
      CHECK(message.find("disk") == std::string::npos);
    }
  }
}

TEST_SUITE("heavy") {
  TEST_CASE("boards with a corner or a line through the pixel's centre are within their bounds") {
    for (const std::string& text : test::radial_texts()) {
      RadialComparison compare(text);
      // Squares of 3/4 and 3/2 pixels, level and turned by 45 degrees, a corner at (8.5, 8.5); then moved by little.
      for (const double size : {0.75, 1.5}) {
        for (const double move : {0.0, 1e-14, 0.25}) {
          const double f = 1 / size, x = 8.5 + move, y = 8.5 + move / 2;
          compare(scenes::board({f, 0, -f * x, 0, f, -f * y, 0, 0, 1}, {-3, 3, -3, 2}), {8, 8});
          compare(scenes::board({f, f, -f * (x + y), -f, f, f * (x - y), 0, 0, 1}, {-3, 3, -2, 3}), {8, 8});
        }
      }
      MESSAGE(compare.summary());
    }
  }
}

}  // namespace moire
