// Boards without end, up to and across their horizon: box values against squares clipped in 34 digits.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include "engine/exact.h"
#include "engine/random_scenes.h"
#include "oracle/coverage.h"

namespace moire {
namespace {

// A camera over the plane, or its mirror image, and a point of the image at that distance below its horizon.
struct View {
  std::vector<double> homography;
  double x, y;
};

View random_view(Draw& draw, double rows) {
  const scenes::Camera camera{.focal = draw.log_uniform(100, 2000),
                              .principal = {draw.uniform(0, 1000), draw.uniform(0, 1000)},
                              .height = draw.log_uniform(0.2, 20),
                              .pitch = draw.uniform(-10, 60),
                              .yaw = draw.uniform(-180, 180),
                              .roll = draw.uniform(-45, 45)};
  std::vector<double> h = scenes::homography_of(camera);
  // Of the horizon, the point closest to the principal point, then along it and down from it.
  const double size = std::hypot(h[6], h[7]), nx = h[6] / size, ny = h[7] / size;
  const double to_horizon = -(h[6] * camera.principal.x + h[7] * camera.principal.y + h[8]) / size;
  const double along = draw.uniform(-1, 1) * camera.focal;
  View view{std::move(h), camera.principal.x + (to_horizon + rows) * nx - along * ny,
            camera.principal.y + (to_horizon + rows) * ny + along * nx};
  if (draw.coin()) {
    for (std::size_t i = 0; i < 9; i += 3) view.homography[i] = -view.homography[i];
    view.x = -view.x;
  }
  return view;
}

Pixel pixel_at(const View& view) {
  return {static_cast<std::int64_t>(std::floor(view.x)), static_cast<std::int64_t>(std::floor(view.y))};
}

struct Comparison {
  int pixels = 0, open = 0;  // open: of a value neither 0 nor 1
  double worst_error = 0, worst_bound = 0;
  std::vector<double> bounds;

  void operator()(const TestImage& image, const Filter& filter, Pixel pixel, double squares) {
    const Exact got = exact_pixel(image, filter, pixel);
    const oracle::Value truth = oracle::coverage(oracle::board_of(image), pixel, 2 * filter.radius(), squares);
    const long double error = std::fabs(static_cast<long double>(got.value) - truth.value);
    INFO(describe(image, pixel, filter, got, truth));
    CHECK(error <= static_cast<long double>(got.bound) + truth.error);
    CHECK(got.bound <= 0.5);  // where nothing is known the value is half of what is seen
    ++pixels;
    open += truth.value > 0 && truth.value < 1;
    worst_error = std::max(worst_error, static_cast<double>(error - truth.error));
    worst_bound = std::max(worst_bound, got.bound);
    bounds.push_back(got.bound);
  }

  double median_bound() {
    const auto middle = bounds.begin() + static_cast<std::ptrdiff_t>(bounds.size() / 2);
    std::nth_element(bounds.begin(), middle, bounds.end());
    return *middle;
  }

  std::string summary() {
    std::ostringstream text;
    text << std::setprecision(2) << pixels << " pixels, " << open << " neither 0 nor 1, worst error " << worst_error
         << ", bound median " << median_bound() << ", max " << worst_bound;
    return text.str();
  }

  static std::string describe(const TestImage& image, Pixel pixel, const Filter& filter, Exact got,
                              oracle::Value truth) {
    std::ostringstream text;
    text << std::setprecision(17);
    for (const auto& [name, numbers] : image.stored()) {
      text << ' ' << name;
      for (const double v : numbers) text << ' ' << v;
    }
    text << ", pixel " << pixel.x << ' ' << pixel.y << ", width " << 2 * filter.radius() << ": " << got.value << " +- "
         << got.bound << ", oracle " << static_cast<double>(truth.value) << " +- " << static_cast<double>(truth.error);
    return text.str();
  }
};

// Squares in the part of the window around the pixel where W > 0; infinite on the horizon.
double squares_in_window(const TestImage& image, Pixel pixel, double width) {
  const oracle::Board board = oracle::board_of(image);
  const oracle::Quad half = oracle::widen(width) / 2;
  const oracle::Polygon seen = oracle::clip_front(board, pixel, half, 0);
  if (oracle::area(seen) < 4 * half * half * (1 - oracle::Quad(1e-20))) return HUGE_VAL;
  return static_cast<double>(oracle::squares_in(board, pixel, seen));
}

// Pixels 1 to 100 rows below the horizon whose windows hold up to `most` squares.
Comparison below_horizon(std::uint64_t seed, int pixels, double most) {
  Draw draw(seed);
  Comparison compare;
  while (compare.pixels < pixels) {
    // Mostly the plain box; wide ones meet the horizon's neighbourhood from further away.
    const double width = draw.coin() ? 1 : draw.log_uniform(0.25, 4);
    const double rows = draw.log_uniform(1, 100);
    const View view = random_view(draw, rows);
    const TestImage image = scenes::plane(view.homography);
    const Pixel pixel = pixel_at(view);
    if (squares_in_window(image, pixel, width) > most) continue;
    std::ostringstream box;
    box << std::setprecision(17) << "box:width=" << width;
    compare(image, Filter(parse_spec(box.str(), "test")), pixel, most);
  }
  return compare;
}

// Finite boards, far off, whose rims pass through or near a window with up to `most` squares.
Comparison far_rims(std::uint64_t seed, int pixels, double most) {
  Draw draw(seed);
  const Filter box(parse_spec("box", "test"));
  Comparison compare;
  while (compare.pixels < pixels) {
    const View view = random_view(draw, draw.log_uniform(0.3, 10));
    const Seen at = look(view.homography, {view.x, view.y});
    const auto below = [&](double x) { return std::floor(x) - std::floor(draw.log_uniform(1, 200)); };
    const auto above = [&](double x) { return x + draw.log_uniform(1, 200); };
    const TestImage image = scenes::board(view.homography, {below(at.u), above(at.u), below(at.v), above(at.v)});
    const oracle::Board board = oracle::board_of(image);
    const double squares = (board.extent[1] - board.extent[0]) * (board.extent[3] - board.extent[2]);
    if (squares > 4 * most) continue;
    compare(image, box, pixel_at(view), most);
  }
  return compare;
}

// Pixels whose windows meet the horizon, or nearly.
Comparison across_horizon(std::uint64_t seed, int pixels, double squares) {
  Draw draw(seed);
  const Filter box(parse_spec("box", "test"));
  Comparison compare;
  while (compare.pixels < pixels) {
    const View view = random_view(draw, draw.uniform(-0.7, 0.9));
    compare(scenes::plane(view.homography), box, pixel_at(view), squares);
  }
  return compare;
}

}  // namespace

TEST_SUITE("heavy") {
  TEST_CASE("infinite boards 1 to 100 rows below the horizon agree with 34 digits within their bounds") {
    Comparison compare = below_horizon(31, 3000, 2000);
    MESSAGE(compare.summary());
    CHECK(compare.open > 1500);
    // The aim; what is above it are windows that are a thousand times closer to the horizon than the focal length.
    CHECK(compare.median_bound() < 1e-12);
    CHECK(compare.worst_bound < 1e-11);
  }

  TEST_CASE("infinite boards on their horizon agree with 34 digits within their bounds") {
    Comparison compare = across_horizon(32, 80, 400);
    MESSAGE(compare.summary());
    CHECK(compare.open > 40);
    CHECK(compare.median_bound() < 1e-4);
  }

  TEST_CASE("far off finite boards agree with 34 digits within their bounds") {
    Comparison compare = far_rims(36, 300, 2000);
    MESSAGE(compare.summary());
    CHECK(compare.open > 100);
    CHECK(compare.worst_bound < 1e-11);
  }
}

TEST_SUITE("unit") {
  TEST_CASE("pixels above the horizon are exactly 0") {
    Draw draw(33);
    const Filter box(parse_spec("box", "test"));
    for (int i = 0; i < 2000; ++i) {
      // Beyond half the diagonal of the grown window.
      const View view = random_view(draw, -draw.log_uniform(1.42, 1000));
      const TestImage image = scenes::plane(view.homography);
      const Exact got = exact_pixel(image, box, pixel_at(view));
      CHECK(got.value == 0);
      CHECK(got.bound == 0);
    }
  }

  TEST_CASE("a side of many lines that comes to less than the aim is left out, and its bound says so") {
    // u = (r a + b x) / y + 1/2 and v = a / y: on the window's left side x = 0 u - r v is 1/2, and with r a ratio of
    // odd numbers both families of lines cross it in step. What is left out there is no rounding: for r = 1 the mean of
    // E_1(u) s(v) is 1/4, and the value is off by the integral of y over 8 b. On the right side nothing is in step.
    double nearest = 0;
    for (const double ratio : {1.0, 1.0 / 3, 3.0 / 5})
      for (const double aim : {1e-4, 1e-3, 1e-2})
        for (const std::int64_t row : {0, 1, 3})
          for (const std::string name : {"box", "tent"}) {
            const Filter filter(parse_spec(name, "test"));
            // So that a side comes to an eighth of what may be left out.
            const double b = 8 * static_cast<double>(row + 1) / aim, a = 8 * b;
            const TestImage image = scenes::plane({b, 0.5, ratio * a, 0, 0, a, 0, 1, 0});
            const auto reach = static_cast<std::int64_t>(filter.radius() - 0.5);
            const Pixel pixel{reach, row + reach};
            const Exact coarse = exact_pixel(image, filter, pixel, WeightAim::everywhere(aim)),
                        fine = exact_pixel(image, filter, pixel, WeightAim::everywhere(1e-9));
            CAPTURE(name);
            CAPTURE(ratio);
            CAPTURE(aim);
            CAPTURE(row);
            CHECK(fine.bound <= 1e-9);
            CHECK(coarse.bound <= aim);
            CHECK(std::fabs(coarse.value - fine.value) <= coarse.bound + fine.bound);
            if (filter.is_unit_box() && ratio == 1 && aim < 1e-2) {
              const double off = (static_cast<double>(row) + 0.5) / (8 * b);
              // To first order: sides' first and last squares are one in b, lines on the right 1 / 500 of their number.
              CHECK(std::fabs(coarse.value - fine.value) == doctest::Approx(off).epsilon(0.01));
              nearest = std::max(nearest, std::fabs(coarse.value - fine.value) / coarse.bound);
            }
          }
    MESSAGE("largest share of the bound " << nearest);
    CHECK(nearest > 0.2);
  }

  TEST_CASE("long stretches of very many lines under kernels that are no polynomials are known by short ones") {
    // Windows of 10^5 to 10^9 lines a side, the second one with all of its board within 10^-9 of the horizon.
    // Integrated from line to line as far as 300,000 lines go, and with one polynomial in W for the kernel along the
    // rest, these bounds were 1.4e-5, after four seconds, and 0.062, after eight.
    const auto pixel_of = [](const std::vector<double>& h, const char* name, Pixel pixel) {
      return exact_pixel(scenes::plane(h), Filter(parse_spec(name, "test")), pixel);
    };
    const Exact near = pixel_of({15768.65, 8192, -65536, 8192, 2, 10, 0.5, 0.25, -4}, "pbrt-sinc", {5, 4});
    CHECK(near.bound < 1e-6);
    const Exact far = pixel_of({-1.1007698705798898e-09, -2.2068132269430944e-09, 0.18094066584427246,
                                -2.360615611059123e-09, 1.1904856883305896e-09, 0.0057100645893811263,
                                9.0552823358604886e-10, 1.6713739168574133e-09, 0.93265531207667984},
                               "windowed-sinc:window=kaiser", {-233721373, -431390010});
    CHECK(far.bound < 1e-3);
  }

  TEST_CASE("some squares beside the horizon, all but lines, are clipped where the series does not tell them apart") {
    // Boards of 48 and 60 squares some 10^-5 pixels high. By the series the bounds were 2.4e-8 and 2.5e-11, and the
    // first value was off by 3.6e-12.
    struct Board {
      std::vector<double> homography, extent;
      Pixel pixel;
      double value;
    };
    const Board boards[] = {
        {{-0.0010278724691662466, 0.00048771717082451337, 429214437.35027248, 0.00094484839694082676,
          0.00089094698802074659, 784075961.98539662, 0.0014871400542057006, -0.0044992227304800538,
          -3959531193.0166678},
         {6238, 6246, 10526, 10530.830469268249},
         {195, -880047828240},
         1.881490488666805e-07},
        {{-0.0095405650083455872, 0.0088435118255217101, -3753204986.7074862, 0.0094233255048413751,
          0.021856150824087536, 3707083630.2964969, 0.00636069518449448, -0.0018772808017642438, 2502261962.0186739},
         {243202, 243208.45625406987, 69218, 69227.360388468442},
         {-393394415187, -140},
         2.3849540916593748e-10}};
    const Filter box(parse_spec("box", "test"));
    for (const Board& b : boards) {
      const Exact e = exact_pixel(scenes::board(b.homography, b.extent), box, b.pixel);
      CHECK(e.bound < 1e-12);
      // Of 113 bits, printed with 16 digits.
      CHECK(std::fabs(e.value - b.value) <= e.bound + 1e-15 * b.value);
    }
  }
}

TEST_SUITE("slow") {
  TEST_CASE("more infinite boards, with up to 5000 squares in a window, agree with 34 digits within their bounds") {
    Comparison compare = below_horizon(34, 10000, 5000);
    MESSAGE(compare.summary());
    Comparison across = across_horizon(35, 300, 5000);
    MESSAGE(across.summary());
  }
}

}  // namespace moire
