// The oracle against itself by unrelated methods, and against the scenes' definitions by counting points.
#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <string>

#include "filter_list.h"
#include "oracle/coverage.h"
#include "oracle/filtered.h"
#include "oracle/polar.h"

namespace moire::oracle {
namespace {

using Random = std::mt19937_64;
// std::uniform_* differ between libraries; tests must not.
double uniform(Random& random, double lo, double hi) {
  return lo + (hi - lo) * (static_cast<double>(random() >> 11) * 0x1p-53);
}

Edge random_edge(Random& random, double reach) {
  const double angle = uniform(random, 0, 6.3);
  return {{uniform(random, 0.5 - reach, 0.5 + reach), uniform(random, 0.5 - reach, 0.5 + reach)},
          {std::cos(angle), std::sin(angle)}};
}

Disk random_disk(Random& random, double reach, double log_lo, double log_hi) {
  const double angle = uniform(random, 0, 6.3), r = std::pow(10, uniform(random, log_lo, log_hi));
  const double x = uniform(random, 0.5 - reach, 0.5 + reach), y = uniform(random, 0.5 - reach, 0.5 + reach);
  return {{x - r * std::cos(angle), y - r * std::sin(angle)}, r};
}

// A tilted plane with squares of about `pixels` pixels near pixel (0, 0).
Board random_board(Random& random, double pixels) {
  const double angle = uniform(random, 0, 6.3), c = std::cos(angle) / pixels, s = std::sin(angle) / pixels;
  return {{c, -s, uniform(random, 0, 2), s, c, uniform(random, 0, 2), uniform(random, -0.02, 0.02),
           uniform(random, -0.02, 0.02), 1},
          {-4, 5.25, -3.5, 4}};
}

bool near(const Value& a, const Value& b) { return std::fabs(a.value - b.value) <= a.error + b.error; }

// How often a kernel is tried: those that are no polynomials take 20 times as long, and are twice as many.
int repeats(const std::string& text) { return half_kernel(parse_spec(text, "test")).degree >= 0 ? 4 : 1; }

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("kernels are normalised and the Gaussian's mass is that of the error function") {
    for (const std::string& name : test::separable_texts()) {
      const Kernel k(name);
      CAPTURE(std::string(name));
      CHECK(std::fabs(k.over(-k.radius(), k.radius()) - 1) < 1e-18L);
      const long double r = k.radius() / 3;
      CHECK(std::fabs(k.over(-k.radius(), r) + k.over(r, k.radius()) - 1) < 1e-18L);
    }
    // Normal distribution inside 3 sigma over its density's peak: the normalised kernel at 0.
    const long double sigma = 0.5L, inside = std::erf(3 / std::numbers::sqrt2_v<long double>);
    const long double peak = std::numbers::inv_sqrtpi_v<long double> / (std::numbers::sqrt2_v<long double> * sigma);
    CHECK(std::fabs(Kernel("gaussian:cut=cut")(0) - peak / inside) < 1e-18L);
    CHECK(Kernel("mitchell")(0) == doctest::Approx(8.0 / 9).epsilon(1e-15));
    CHECK(Kernel("catmull-rom")(0) == doctest::Approx(1).epsilon(1e-15));
  }

  TEST_CASE("closed-form box coverage agrees with iterated quadrature within both stated errors") {
    Random random(1);
    for (const double width : {1.0, 1.7}) {
      const Kernel k(width == 1 ? "box" : "box:width=1.7");
      for (int i = 0; i < 200; ++i) {
        CAPTURE(i);
        const Edge e = random_edge(random, width / 2);
        CHECK(near(coverage(e, {0, 0}, width), filtered(k, e, {0, 0})));
        const Disk d = random_disk(random, width / 2, -6, 9);
        CHECK(near(coverage(d, {0, 0}, width), filtered(k, d, {0, 0})));
        const Board b = random_board(random, uniform(random, 0.5, 5));
        CHECK(near(coverage(b, {0, 0}, width), filtered(k, b, {0, 0})));
      }
    }
  }

  TEST_CASE("sections along rows and along columns give the same board, and its squares make the whole") {
    Random random(5);
    for (const std::string& name : test::separable_texts()) {
      const Kernel k(name);
      CAPTURE(std::string(name));
      for (int i = 0; i < repeats(name); ++i) {
        Board b = random_board(random, uniform(random, 0.7, 5));
        const Value rows = filtered(k, b, {0, 0});
        Board transposed = b;
        for (std::size_t r = 0; r < 9; r += 3) std::swap(transposed.homography[r], transposed.homography[r + 1]);
        CHECK(near(rows, filtered(k, transposed, {0, 0})));
        // Big enough to hold the window whole; the black squares are the white ones of the plane moved by one.
        b.extent = {-64, 64, -64, 64};
        Value both = filtered(k, b, {0, 0});
        for (std::size_t c = 0; c < 3; ++c) b.homography[c] += b.homography[6 + c];
        b.extent = {-63, 65, -64, 64};
        both += filtered(k, b, {0, 0});
        // The moved homography is rounded: an offset of half an ulp of 2 at squares of 0.7 pixel and more.
        CHECK(std::fabs(both.value - 1) < 1e-14L);
      }
    }
  }

  TEST_CASE("moving scene and pixel together by 2^40 pixels changes nothing") {
    const double far = 0x1p40;
    const auto base = static_cast<std::int64_t>(far);
    for (const std::string& name : test::separable_texts()) {
      const Kernel k(name);
      CAPTURE(std::string(name));
      for (const double x : {0.25, 0.5, 0.75}) {
        const Edge e{{x, 0.5}, {0.8, -0.3}}, e_far{{x + far, 0.5 - far}, {0.8, -0.3}};
        CHECK(near(filtered(k, e, {0, 0}), filtered(k, e_far, {base, -base})));
        const Disk d{{x - 1e5, 1}, 1e5}, d_far{{x - 1e5 + far, 1 - far}, 1e5};
        CHECK(near(filtered(k, d, {0, 0}), filtered(k, d_far, {base, -base})));
      }
    }
  }

  TEST_CASE("the stated errors are below 1e-17") {
    Random random(3);
    for (const std::string& name : test::separable_texts()) {
      const Kernel k(name);
      CAPTURE(std::string(name));
      const double reach = static_cast<double>(k.radius());
      for (int i = 0; i < 20; ++i) {
        CHECK(filtered(k, random_edge(random, reach), {0, 0}).error < 1e-17L);
        CHECK(filtered(k, random_disk(random, reach, -6, 9), {0, 0}).error < 1e-17L);
      }
    }
  }

  TEST_CASE("shapes are where the definitions put them: counts of 200 x 200 points per pixel") {
    Random random(4);
    constexpr int kSide = 200;
    // A straight boundary moves at most its crossed cells, two or three per row, between counted and not.
    constexpr double kTolerance = 3.0 / kSide;
    const auto count = [](const auto& inside) {
      int n = 0;
      for (int j = 0; j < kSide; ++j)
        for (int i = 0; i < kSide; ++i) n += inside((i + 0.5) / kSide - 3, (j + 0.5) / kSide + 7) ? 1 : 0;
      return n / double(kSide * kSide);
    };
    const Pixel pixel{-3, 7};
    for (int i = 0; i < 20; ++i) {
      Edge e = random_edge(random, 0.5);
      e.through[0] -= 3, e.through[1] += 7;
      const auto in_edge = [&](double x, double y) {
        return (x - e.through[0]) * e.normal[0] + (y - e.through[1]) * e.normal[1] >= 0;
      };
      CHECK(static_cast<double>(coverage(e, pixel, 1).value) == doctest::Approx(count(in_edge)).epsilon(kTolerance));
      Disk d = random_disk(random, 0.5, -1, 2);
      d.center[0] -= 3, d.center[1] += 7;
      const auto in_disk = [&](double x, double y) { return std::hypot(x - d.center[0], y - d.center[1]) <= d.radius; };
      CHECK(std::fabs(static_cast<double>(coverage(d, pixel, 1).value) - count(in_disk)) < kTolerance);
      const Board b = random_board(random, uniform(random, 2, 12));
      const auto in_board = [&](double x, double y) {
        const auto& h = b.homography;
        const double w = h[6] * x + h[7] * y + h[8];
        const double u = (h[0] * x + h[1] * y + h[2]) / w, v = (h[3] * x + h[4] * y + h[5]) / w;
        return w > 0 && u >= b.extent[0] && u < b.extent[1] && v >= b.extent[2] && v < b.extent[3] &&
               std::fmod(std::fabs(std::floor(u) + std::floor(v)), 2) == 0;
      };
      // At most three boundaries cross the pixel here.
      CHECK(std::fabs(static_cast<double>(coverage(b, pixel, 1).value) - count(in_board)) < 3 * kTolerance);
    }
  }

  TEST_CASE("tangent circles and circles inside a pixel, where a comparison with <= once lost 0.21 square pixel") {
    constexpr long double kPi = std::numbers::pi_v<long double>;
    // Inside and touching one, two or all sides; touching a side from outside; around the pixel.
    CHECK(std::fabs(coverage(Disk{{4.5, 4.5}, 0.5}, {4, 4}, 1).value - kPi / 4) < 1e-17L);
    CHECK(std::fabs(coverage(Disk{{4.25, 4.25}, 0.25}, {4, 4}, 1).value - kPi / 16) < 1e-17L);
    CHECK(coverage(Disk{{3.5, 4.5}, 0.5}, {4, 4}, 1).value == 0);
    CHECK(std::fabs(coverage(Disk{{4.5, 4.5}, 1}, {4, 4}, 1).value - 1) < 1e-17L);
    CHECK(std::fabs(coverage(Disk{{4, 4}, 1}, {4, 4}, 1).value - kPi / 4) < 1e-17L);
    CHECK(std::fabs(coverage(Disk{{4, 4}, 0.5}, {4, 4}, 1).value - kPi / 16) < 1e-17L);
    CHECK(std::fabs(coverage(Disk{{4.5, 5}, 0.5}, {4, 4}, 1).value - kPi / 8) < 1e-17L);
    CHECK(std::fabs(coverage(Disk{{4.5, 4 + 0x1p-30}, 0x1p-30}, {4, 4}, 1).value - kPi * 0x1p-60L) < 1e-35L);
  }
}

TEST_SUITE("heavy") {
  TEST_CASE("iterated quadrature agrees with quadrature along rays, every filter") {
    Random random(2);
    for (const std::string& name : test::separable_texts()) {
      const Kernel k(name);
      CAPTURE(std::string(name));
      const double reach = static_cast<double>(k.radius());
      for (int i = 0; i < repeats(name); ++i) {
        const Edge e = random_edge(random, reach);
        CHECK(near(filtered(k, e, {0, 0}), polar(k, around(e, {0, 0}))));
        const Disk d = random_disk(random, reach, -3, 1);
        CHECK(near(filtered(k, d, {0, 0}), polar(k, around(d, {0, 0}))));
      }
    }
  }
}

}  // namespace moire::oracle
