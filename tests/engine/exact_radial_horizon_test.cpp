// Boards without end under radial filters, up to and across their horizon: against integrals along chords, to about
// 1e-12.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <string>
#include <vector>

#include "engine/exact.h"
#include "engine/exact_compare.h"
#include "engine/random_scenes.h"
#include "filter_list.h"
#include "oracle/one_point_radial.h"
#include "oracle/rings.h"

namespace moire {
namespace {

constexpr double kDegrees = std::numbers::pi / 180;

// A camera without yaw as a pixel sees it; lengths in pixels, x along the horizon, y down from the pixel's centre.
struct View {
  double focal = 100, height = 1;  // height in squares
  double horizon = 0;              // y of the horizon
  double column = 0;               // x of the vanishing point of the columns
  double pitch = 10, roll = 0;     // degrees
  double phase = 0;                // added to u
  bool mirrored = false;
};

TestImage board(const View& view, Pixel pixel) {
  // From the principal point to the pixel's centre, before the roll.
  const double x = -view.column, y = -view.horizon - view.focal * std::tan(view.pitch * kDegrees);
  const double c = std::cos(view.roll * kDegrees), s = std::sin(view.roll * kDegrees);
  const Vec2 centre{static_cast<double>(pixel.x) + 0.5, static_cast<double>(pixel.y) + 0.5};
  std::vector<double> h = scenes::homography_of({.focal = view.focal,
                                                 .principal = {centre.x - (x * c + y * s), centre.y - (y * c - x * s)},
                                                 .height = view.height,
                                                 .pitch = view.pitch,
                                                 .roll = view.roll});
  for (std::size_t i = 0; i < 3; ++i) h[i] += view.phase * h[6 + i];
  return scenes::plane(std::move(h));
}

// The image left for right about x = 0, exactly.
TestImage mirrored(const TestImage& image) {
  const auto& h = oracle::board_of(image).homography;
  return scenes::plane({-h[0], h[1], h[2], -h[3], h[4], h[5], -h[6], h[7], h[8]});
}
Pixel mirrored(Pixel p) { return {-1 - p.x, p.y}; }

// A quarter turn about the origin, exactly: what was at (x, y) is at (-y, x).
TestImage turned(const TestImage& image) {
  const auto& h = oracle::board_of(image).homography;
  return scenes::plane({-h[1], h[0], h[2], -h[4], h[3], h[5], -h[7], h[6], h[8]});
}
Pixel turned(Pixel p) { return {-1 - p.y, p.x}; }

class HorizonComparison {
 public:
  explicit HorizonComparison(const std::string& filter)
      : text_(filter), filter_(parse_spec(filter, "test")), kernel_(filter) {}

  double radius() const { return filter_.radius(); }

  // Checks |product - reference| <= bound + reference's error, and that the reference is one.
  void operator()(const View& view, Pixel pixel) const {
    TestImage image = board(view, pixel);
    if (view.mirrored) {
      image = mirrored(image);
      pixel = mirrored(pixel);
    }
    const oracle::Value truth = oracle::one_point(kernel_, oracle::board_of(image), pixel);
    const Exact got = exact_pixel(image, filter_, pixel);
    INFO(describe_pixel(image, pixel, text_, got, truth));
    CHECK(std::fabs(static_cast<long double>(got.value) - truth.value) <=
          static_cast<long double>(got.bound) + truth.error);
    CHECK(truth.error < kReference);
  }

 private:
  // Mostly 1e-12, to which limits are extrapolated; more where the rows of squares are 6e5 before they agree.
  static constexpr long double kReference = 1e-10L;

  std::string text_;
  Filter filter_;
  oracle::ChordKernel kernel_;
};

// Through the centre, anywhere through the window, next to the rim of the support on either side, and rows away.
double any_horizon(Draw& draw, double radius) {
  switch (draw.integer(0, 5)) {
    case 0:
      return 0;
    case 1:
      return draw.uniform(-1, 1) * radius;
    case 2:
      return draw.coin() ? radius * draw.uniform(0.9, 0.999) : -radius * (1 - draw.log_uniform(1e-8, 1e-2));
    case 3:
      return -radius * (1 + draw.log_uniform(1e-8, 1e-1));
    case 4:
      return (draw.coin() ? 1 : -1) * draw.log_uniform(1e-9, 1e-2) * radius;
    default:
      return -radius - draw.log_uniform(0.1, 5);
  }
}

// Inside the window and at its sides, where the slopes of u and v along the horizon resonate, and anywhere.
double any_column(Draw& draw, double radius, double focal) {
  constexpr double kResonant[] = {0.2, 1.0 / 3, 1, 0.6, 1.0 / 7, 0.5, 2, 3};
  const double side = draw.coin() ? 1 : -1;
  switch (draw.integer(0, 3)) {
    case 0:
      return side * draw.log_uniform(1e-3, 1) * radius;
    case 1:
      return side * (radius + draw.uniform(-0.5, 0.5));
    case 2:
      return side * focal * kResonant[static_cast<std::size_t>(draw.integer(0, 7))];
    default:
      return draw.uniform(-1.5, 1.5) * focal;
  }
}

// The reference takes time like focal times height, the number of rows of squares down to one row per pixel; of ground
// that ends with the window it knows too little where so narrow a strip holds 7e4 rows.
View any_view(Draw& draw, double radius, double most_rows) {
  constexpr double kFocal[] = {20, 100, 500}, kHeight[] = {0.3, 1, 2, 20}, kRoll[] = {0, 90, 180, 30};
  const auto pick = [&](const auto& list, std::int64_t last) {
    return list[static_cast<std::size_t>(draw.integer(0, last))];
  };
  View view;
  const auto rows = [&] {
    const double slope = std::cos(view.pitch * kDegrees);
    return view.focal * view.height / (slope * slope * std::max(radius - view.horizon, 0.0));
  };
  do {
    do {
      view.focal = pick(kFocal, 2);
      view.height = pick(kHeight, 3);
    } while (view.focal * view.height > most_rows);
    view.horizon = any_horizon(draw, radius);
    view.column = any_column(draw, radius, view.focal);
    view.pitch = draw.uniform(-10, 40);
    view.roll = draw.coin() ? 0 : draw.coin() ? pick(kRoll, 3) : draw.uniform(-180, 180);
    view.phase = draw.coin() ? 0 : draw.coin() ? 0.5 : draw.uniform(-1, 1);
    view.mirrored = draw.coin();
  } while (rows() > 7e4);
  return view;
}

void compare_any(std::uint64_t seed, int cases, double most_rows) {
  Draw draw(seed);
  const std::vector<std::string> texts = test::radial_texts();
  std::map<std::string, HorizonComparison> comparisons;
  for (int i = 0; i < cases; ++i) {
    const std::string& text = texts[static_cast<std::size_t>(i) % texts.size()];
    const HorizonComparison& compare = comparisons.try_emplace(text, text).first->second;
    compare(any_view(draw, compare.radius(), most_rows), {draw.integer(-200, 200), draw.integer(-200, 200)});
  }
}

// Every radial filter without parameters, and those of another kind.
const std::vector<std::string>& usual_filters() {
  static const std::vector<std::string> kTexts{"disk",
                                               "cone",
                                               "radial-gaussian",
                                               "radial-gaussian:cut=cut",
                                               "radial-bc",
                                               "radial-bc:preset=ospray-mitchell",
                                               "radial-lanczos",
                                               "radial-blackman-harris",
                                               "jinc"};
  return kTexts;
}

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("boards on their horizon under radial filters agree with integrals along chords within their bounds") {
    for (const std::string& text : usual_filters()) {
      const HorizonComparison compare(text);
      compare({.focal = 20, .height = 2, .horizon = -0.4, .column = 4, .roll = 37}, {100, -7});
      // The horizon through the centre, where a cone has its cusp and a disk nothing.
      if (text == "cone" || text == "disk") compare({.focal = 20, .column = 0.3, .phase = 0.25}, {3, 5});
    }
  }

  // What the two share is the published formula of the kernel; rings know nothing of chords or waves.
  TEST_CASE("below the horizon integrals along chords are the sums of squares clipped into rings") {
    double roll = 0;
    for (const char* text : {"disk", "cone", "radial-gaussian", "radial-bc", "radial-lanczos:a=1"}) {
      CAPTURE(std::string(text));
      const oracle::ChordKernel chords(text);
      const oracle::RingKernel rings(text);
      const double horizon = -static_cast<double>(rings.radius()) - 1;
      const View view{.focal = 8, .height = 0.5, .horizon = horizon, .column = 0.4, .roll = roll, .phase = 0.3};
      roll += 90;
      const oracle::Board seen = oracle::board_of(board(view, {2, 1}));
      const oracle::Value chord = oracle::one_point(chords, seen, {2, 1}), ring = oracle::filtered(rings, seen, {2, 1});
      CHECK(std::fabs(chord.value - ring.value) <= chord.error + ring.error);
      CHECK(chord.error < 1e-13L);
      CHECK(ring.error < 1e-13L);
    }
  }

  TEST_CASE("chords wave by wave and by their ends are the same") {
    for (const std::string& text : test::radial_texts()) {
      CAPTURE(text);
      const oracle::ChordKernel k(text);
      for (const long double y : {1e-6L, 1e-3L, 0.03L, -0.3L, 0.7L, 0.999L})
        for (const long double rate : {1.0L, 1.3L, 3.0L})
          for (const long double phase : {0.0L, 0.37L, 1.5L}) {
            const oracle::ChordWave wave{phase, rate * k.least_rate()};
            const long double gap = k.wave_by_wave(y * k.radius(), wave) - k.by_ends(y * k.radius(), wave);
            // Orders of Boole's formula are left out below 1e-14 of k(0).
            CHECK(std::fabs(gap) < 4e-14L * k.rings()(0));
          }
    }
  }

  TEST_CASE("boards across their horizon, mirrored or turned by 90 degrees, keep their values under radial filters") {
    Draw draw(61);
    for (const std::string& text : usual_filters()) {
      CAPTURE(text);
      const Filter filter(parse_spec(text, "test"));
      View view = any_view(draw, filter.radius(), 500);
      view.horizon = draw.uniform(-1, 1) * filter.radius();
      const Pixel pixel{draw.integer(-200, 200), draw.integer(-200, 200)};
      const TestImage image = board(view, pixel);
      const Exact one = exact_pixel(image, filter, pixel);
      const Exact left = exact_pixel(mirrored(image), filter, mirrored(pixel));
      const Exact quarter = exact_pixel(turned(image), filter, turned(pixel));
      CHECK(std::fabs(one.value - left.value) <= one.bound + left.bound);
      CHECK(std::fabs(one.value - quarter.value) <= one.bound + quarter.bound);
    }
  }

  TEST_CASE("boards across their horizon, rolled about the pixel's centre, keep their values under radial filters") {
    Draw draw(62);
    for (const std::string& text : usual_filters()) {
      CAPTURE(text);
      const Filter filter(parse_spec(text, "test"));
      // The principal point is the centre of pixel (7, -3); yaw makes it another place than the vanishing point.
      scenes::Camera camera{.focal = draw.log_uniform(20, 500),
                            .principal = {7.5, -2.5},
                            .height = draw.log_uniform(0.3, 5),
                            .yaw = draw.uniform(-60, 60)};
      camera.pitch = std::atan(draw.uniform(-1, 1) * filter.radius() / camera.focal) / kDegrees;
      const Exact level = exact_pixel(scenes::plane(camera), filter, {7, -3});
      for (const double roll : {37.0, -draw.uniform(0, 180)}) {
        camera.roll = roll;
        const Exact rolled = exact_pixel(scenes::plane(camera), filter, {7, -3});
        // The nine doubles are rounded otherwise, by some 1e-15 of a row: lines move by as much over their depth below
        // the horizon, whose integral over the window is a logarithm, below 40.
        CHECK(std::fabs(level.value - rolled.value) <= level.bound + rolled.bound + 1e-13);
      }
    }
  }
}

TEST_SUITE("heavy") {
  TEST_CASE("random boards about their horizon under every radial filter are within their bounds of chords") {
    compare_any(63, 70, 500);
  }
}

TEST_SUITE("slow") {
  TEST_CASE("many random boards about their horizon under every radial filter are within their bounds of chords") {
    compare_any(64, 280, 1e4);
  }
}

}  // namespace moire
