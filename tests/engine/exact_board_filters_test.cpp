// Boards with many squares in a window, and with their horizon, under every kind of separable filter: against squares
// integrated one by one in extended precision, and against identities where there is no end of them.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>
#include <string>
#include <vector>

#include "engine/exact.h"
#include "engine/random_scenes.h"
#include "oracle/filtered.h"
#include "stress/views.h"

namespace moire {
namespace {

using scenes::View;
using scenes::view_of;

const char* const kFilters[] = {"box",         "box:width=1.7",   "tent",     "bspline", "bspline:order=2", "mitchell",
                                "catmull-rom", "bspline:order=5", "gaussian", "lanczos", "blackman-harris"};

Filter filter_of(const std::string& text) { return Filter(parse_spec(text, "test")); }

std::string describe(const TestImage& image, Pixel pixel, const Filter& filter, Exact got) {
  std::ostringstream text;
  text << std::setprecision(17);
  for (const auto& [name, numbers] : image.stored()) {
    text << ' ' << name;
    for (const double v : numbers) text << ' ' << v;
  }
  text << ", pixel " << pixel.x << ' ' << pixel.y << ", " << filter.text() << ": " << got.value << " +- " << got.bound;
  return text.str();
}

// Hard ones by turns: any camera, one-point perspective and resonant columns, 45 degrees, its mirror image, matrices
// that are nearly singular.
View hard_view(Draw& draw, double rows) {
  const int kind = static_cast<int>(draw.integer(0, 5));
  scenes::Camera camera{.focal = draw.log_uniform(100, 2000),
                        .principal = {draw.uniform(0, 1000), draw.uniform(0, 1000)},
                        .height = draw.log_uniform(0.2, 10),
                        .pitch = draw.uniform(-10, 60),
                        .yaw = draw.uniform(-180, 180),
                        .roll = draw.uniform(-180, 180)};
  double along = draw.uniform(-1, 1);
  if (kind == 1) {
    camera.focal = static_cast<double>(draw.integer(20, 80)) * 15;
    camera.principal = {512, 384};
    camera.pitch = camera.roll = 0;
    camera.yaw = draw.coin() ? 0 : 45;
    const double ratios[] = {0, 1, 1.0 / 3, 1.0 / 5, 3.0 / 5, -1.0 / 3, 1.0 / 2};
    along = ratios[draw.integer(0, 6)];
  }
  if (kind == 2) camera.roll = 45, camera.yaw = 0;
  View view = view_of(camera, rows, along);
  if (kind == 3) {
    for (std::size_t i = 0; i < 9; i += 3) view.homography[i] = -view.homography[i];
    view.at.x = -view.at.x;
  }
  if (kind == 4) {  // u is almost a function of v
    for (std::size_t i = 0; i < 3; ++i) {
      view.homography[i] = view.homography[3 + i] + draw.log_uniform(1e-9, 1e-2) * view.homography[i];
    }
  }
  return view;
}

// A finite board around the place, of a size that keeps the oracle's work in hand.
TestImage board_around(Draw& draw, const View& view, double squares) {
  const Seen at = look(view.homography, view.at);
  const double side = std::sqrt(squares);
  const auto low = [&](double x) { return std::floor(x) - std::floor(draw.uniform(0.2, 1.3) * side); };
  const auto high = [&](double x) { return x + draw.uniform(0.2, 0.7) * side; };
  return scenes::board(view.homography, {low(at.u), high(at.u), low(at.v), high(at.v)});
}

struct Tally {
  int open = 0, pixels = 0;
  double worst_error = 0, worst_bound = 0, worst_ratio = 0;
  std::vector<double> bounds;
  std::string summary() {
    std::sort(bounds.begin(), bounds.end());
    std::ostringstream text;
    text << std::setprecision(2) << pixels << " pixels, " << open << " neither 0 nor 1, worst error " << worst_error
         << ", worst error over bound " << worst_ratio << ", bound median " << bounds[bounds.size() / 2] << ", max "
         << worst_bound;
    return text.str();
  }
};

// Finite boards near the horizon, up to so many squares each, against the oracle.
Tally against_oracle(std::uint64_t seed, int pixels, double squares) {
  Draw draw(seed);
  std::vector<Filter> filters;
  std::vector<oracle::Kernel> kernels;
  for (const char* text : kFilters) {
    filters.push_back(filter_of(text));
    kernels.emplace_back(text);
  }
  Tally tally;
  for (std::size_t turn = 0; tally.pixels < pixels; ++turn) {
    const std::size_t f = turn % filters.size();
    const View view = hard_view(draw, draw.coin() ? draw.log_uniform(0.1, 60) : draw.uniform(-0.7, 1));
    const Seen at = look(view.homography, view.at);
    if (!(at.w > 0) || !(std::fabs(at.u) < 1e9) || !(std::fabs(at.v) < 1e9)) continue;
    const TestImage image = board_around(draw, view, squares);
    const Exact got = exact_pixel(image, filters[f], view.pixel());
    const oracle::Value truth = oracle::filtered(kernels[f], oracle::board_of(image), view.pixel());
    const double error = static_cast<double>(std::fabs(static_cast<long double>(got.value) - truth.value));
    INFO(describe(image, view.pixel(), filters[f], got));
    CHECK(error <= got.bound + static_cast<double>(truth.error));
    ++tally.pixels;
    tally.open += truth.value > 0 && truth.value < 1;
    tally.worst_error = std::max(tally.worst_error, error);
    tally.worst_bound = std::max(tally.worst_bound, got.bound);
    if (got.bound > 0) {
      tally.worst_ratio = std::max(tally.worst_ratio, (error - static_cast<double>(truth.error)) / got.bound);
    }
    tally.bounds.push_back(got.bound);
  }
  return tally;
}

// Pixels of infinite boards; checks bounds against the targets for kernels of low degree.
struct Targets {
  double off_horizon = 0, on_horizon = 0;  // largest bounds
  int pixels = 0;
  void operator()(const TestImage& image, const Filter& filter, Pixel pixel) {
    const Exact got = exact_pixel(image, filter, pixel);
    const double r = filter.radius();
    const bool horizon = image.meets_horizon(pixel, {{0.5 - r, 0.5 - r}, {0.5 + r, 0.5 + r}});
    INFO(describe(image, pixel, filter, got));
    CHECK(got.bound <= (horizon ? 1e-9 : 1e-12));
    (horizon ? on_horizon : off_horizon) = std::max(horizon ? on_horizon : off_horizon, got.bound);
    ++pixels;
  }
};

// Values that should be the same.
void check_same(Exact a, Exact b) { CHECK(std::fabs(a.value - b.value) <= a.bound + b.bound); }

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("boards of many squares agree with the oracle within their bounds under every kind of filter") {
    Tally tally = against_oracle(71, 60, 400);
    MESSAGE(tally.summary());
    CHECK(tally.open > 50);
    CHECK(tally.worst_bound < 1e-9);
  }

  TEST_CASE("box and cubics reach 1e-12 off the horizon and 1e-9 on it") {
    Targets targets;
    for (const char* text : {"box", "tent", "mitchell", "catmull-rom"}) {
      const Filter filter = filter_of(text);
      for (const double height : {1.0, 5.0})
        for (const double yaw : {0.0, 20.0, 45.0})
          for (const double along : {0.0, 0.2, 0.37})
            for (const double rows : {0.3, 3.6}) {
              const scenes::Camera camera{
                  .focal = 512, .principal = {256, 256}, .height = height, .pitch = 10, .yaw = yaw};
              const View view = view_of(camera, rows, along);
              targets(scenes::plane(view.homography), filter, view.pixel());
            }
    }
    MESSAGE(targets.pixels << " pixels, largest bounds " << targets.off_horizon << " off the horizon, "
                           << targets.on_horizon << " on it");
  }

  TEST_CASE("mirrored, turned and exchanged scenes have the same values on their horizon") {
    Draw draw(73);
    const Filter filter = filter_of("mitchell");
    for (int i = 0; i < 4; ++i) {
      const View view = hard_view(draw, draw.uniform(-1, 1));
      const Pixel p = view.pixel();
      const std::vector<double>& h = view.homography;
      const Exact got = exact_pixel(scenes::plane(h), filter, p);
      CAPTURE(i);
      std::vector<double> mirrored = h, turned = h, exchanged = h;
      for (std::size_t row = 0; row < 9; row += 3) {
        mirrored[row] = -h[row];
        turned[row] = h[row + 1];  // x and y exchanged
        turned[row + 1] = h[row];
      }
      for (std::size_t k = 0; k < 3; ++k) std::swap(exchanged[k], exchanged[3 + k]);
      check_same(got, exact_pixel(scenes::plane(mirrored), filter, {-1 - p.x, p.y}));
      check_same(got, exact_pixel(scenes::plane(turned), filter, {p.y, p.x}));
      check_same(got, exact_pixel(scenes::plane(exchanged), filter, p));
    }
  }

  TEST_CASE("a finite board that grows tends to the whole plane") {
    const scenes::Camera camera{.focal = 500, .principal = {300, 200}, .height = 1, .pitch = 12, .yaw = 30};
    for (const char* text : {"box", "mitchell"}) {
      const Filter filter = filter_of(text);
      const View view = view_of(camera, 0.2, 0.13);
      const Exact whole = exact_pixel(scenes::plane(view.homography), filter, view.pixel());
      for (const double far : {1e3, 1e5, 1e7, 1e10}) {
        const Exact part = exact_pixel(scenes::board(view.homography, {-far, far, -far, far}), filter, view.pixel());
        CAPTURE(text);
        CAPTURE(far);
        // Rows nearer to the horizon than focal height / far hold what is missing, |k k| < 1 on 4 pixels of them;
        // twice that for yaw.
        CHECK(std::fabs(part.value - whole.value) <= 2 * 4 * 500 / far + part.bound + whole.bound);
        CHECK(part.bound < 1e-8);
      }
    }
  }

  TEST_CASE("a larger aim takes less time and a smaller one gives a smaller bound, and both are true") {
    const scenes::Camera camera{.focal = 500, .principal = {300, 200}, .height = 2, .pitch = 12, .yaw = 30};
    const Filter filter = filter_of("mitchell");
    const View view = view_of(camera, 0.2, 0.13);
    const TestImage image = scenes::plane(view.homography);
    const Exact rough = exact_pixel(image, filter, view.pixel(), {1e-4, 1e-4}),
                usual = exact_pixel(image, filter, view.pixel()),
                fine = exact_pixel(image, filter, view.pixel(), {1e-12, 1e-12});
    check_same(rough, usual);
    check_same(usual, fine);
    CHECK(rough.bound <= 1e-4);
    CHECK(usual.bound <= 1e-9);
    CHECK(fine.bound < usual.bound);
    CHECK(fine.bound <= 1e-11);
  }
}

TEST_SUITE("heavy") {
  TEST_CASE("a spline is a sum of splines of half the width, on the horizon too") {
    // Lane and Riesenfeld, "A theoretical development for the computer generation and display of piecewise polynomial
    // surfaces", 1980: B(x) = sum over i of binomial(d + 1, i) 2^-d B(2 x - i + (d + 1) / 2), here in an image of
    // twice the size, whose pixel centres are moved by one half so that they lie where they should.
    Draw draw(74);
    for (const int degree : {1, 3}) {
      const Filter filter = filter_of(degree == 1 ? "tent" : "bspline");
      const std::vector<double> weights = degree == 1
                                              ? std::vector<double>{0.25, 0.5, 0.25}
                                              : std::vector<double>{1.0 / 16, 4.0 / 16, 6.0 / 16, 4.0 / 16, 1.0 / 16};
      for (int i = 0; i < 3; ++i) {
        View view = hard_view(draw, i == 0 ? draw.uniform(1.5, 4) : draw.uniform(-0.7, 0.7));
        // Multiples of 2^-40, so that the other image's homography is exact.
        for (double& x : view.homography) x = std::round(x * 0x1p40) * 0x1p-40;
        std::vector<double> larger = view.homography;
        for (std::size_t row = 0; row < 9; row += 3) {
          larger[row] /= 2;
          larger[row + 1] /= 2;
          larger[row + 2] +=
              (larger[row] + larger[row + 1]) * -0.5 + (view.homography[row] + view.homography[row + 1]) * 0.5;
        }
        const Pixel p = view.pixel();
        const Exact whole = exact_pixel(scenes::plane(view.homography), filter, p);
        const TestImage image = scenes::plane(larger);
        Exact sum;
        const auto reach = static_cast<std::int64_t>(weights.size() / 2);
        for (std::int64_t y = -reach; y <= reach; ++y)
          for (std::int64_t x = -reach; x <= reach; ++x) {
            const Exact part = exact_pixel(image, filter, {2 * p.x + x, 2 * p.y + y});
            const double weight =
                weights[static_cast<std::size_t>(x + reach)] * weights[static_cast<std::size_t>(y + reach)];
            sum.value += weight * part.value;
            sum.bound += weight * part.bound + 1e-17;
          }
        CAPTURE(degree);
        CAPTURE(i);
        check_same(whole, sum);
      }
    }
  }

  TEST_CASE("far off pixels have true bounds") {
    // The horizon is a row of pixels; 2^62 columns away it passes through the same windows.
    const std::vector<double> h{1, 0, 0, 0, 0, 1, 0, 0x1p-10, -0x1p-10};
    const TestImage image = scenes::plane(h);
    for (const char* text : {"box", "tent", "mitchell"}) {
      const Filter filter = filter_of(text);
      for (const std::int64_t far : {std::int64_t{1} << 20, std::int64_t{1} << 40, std::int64_t{1} << 62}) {
        for (const std::int64_t row : {std::int64_t{0}, std::int64_t{1}, std::int64_t{3}, far}) {
          for (const std::int64_t x : {far, -far}) {
            const Exact got = exact_pixel(image, filter, {x, row});
            CAPTURE(text);
            CAPTURE(x);
            CAPTURE(row);
            CHECK(got.bound >= 0);
            CHECK(got.bound <= 1.5);
            CHECK(got.value - got.bound <= 1.2);  // mitchell overshoots
            CHECK(got.value + got.bound >= -0.2);
          }
        }
      }
    }
  }

  TEST_CASE("2000 hard boards agree with the oracle within their bounds") {
    Tally tally = against_oracle(75, 2000, 400);
    MESSAGE(tally.summary());
    CHECK(tally.open > 1500);
  }

  TEST_CASE("box and cubics reach 1e-12 off the horizon and 1e-9 on it under any camera") {
    Draw draw(76);
    Targets targets;
    for (const char* text : {"box", "tent", "bspline", "mitchell", "catmull-rom"}) {
      const Filter filter = filter_of(text);
      for (int i = 0; i < 60; ++i) {
        const scenes::Camera camera{.focal = draw.log_uniform(200, 1000),
                                    .principal = {256, 256},
                                    .height = draw.log_uniform(0.3, 10),
                                    .pitch = draw.uniform(0, 30),
                                    .yaw = draw.uniform(-180, 180),
                                    .roll = i % 3 == 0 ? 0 : draw.uniform(-45, 45)};
        const View view =
            view_of(camera, i % 2 == 0 ? draw.uniform(-1, 1) : draw.log_uniform(2, 60), draw.uniform(-0.5, 0.5));
        targets(scenes::plane(view.homography), filter, view.pixel());
      }
    }
    MESSAGE(targets.pixels << " pixels, largest bounds " << targets.off_horizon << " off the horizon, "
                           << targets.on_horizon << " on it");
  }
}

TEST_SUITE("slow") {
  TEST_CASE("100,000 hard boards agree with the oracle within their bounds") {
    Tally tally = against_oracle(72, 100000, 300);
    MESSAGE(tally.summary());
  }
}

}  // namespace moire
