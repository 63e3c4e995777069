// The boundary series of checkerboards: against squares clipped in 34 digits, against clipping in doubles, and against
// itself where nothing else can follow.
#include "testimages/checker_series.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/rounding.h"
#include "engine/random_scenes.h"
#include "oracle/coverage.h"
#include "testimages/board_squares.h"

namespace moire {
namespace {

Matrix3 matrix_of(const std::vector<double>& h) {
  Matrix3 m{};
  std::copy(h.begin(), h.end(), m.begin());
  return m;
}

oracle::Board endless(const Matrix3& h) { return {h, {-HUGE_VAL, HUGE_VAL, -HUGE_VAL, HUGE_VAL}}; }

// A camera whose vanishing lines are easily told: yaw 0, no roll, no pitch: the horizon is the row y = principal.y.
scenes::Camera level(double focal, Vec2 principal, double height) {
  return {.focal = focal, .principal = principal, .height = height, .pitch = 0};
}

// The part of the unit window in front of W = nearest, as doubles.
Polygon front(const Matrix3& h, Pixel pixel, oracle::Quad nearest) {
  Polygon out;
  for (const oracle::Point& p : oracle::clip_front(endless(h), pixel, oracle::Quad(1) / 2, nearest)) {
    out.push_back({static_cast<double>(p.x), static_cast<double>(p.y)});
  }
  return out;
}

// Area of the even squares in there, by clipping each of them in 34 digits.
double truth(const Matrix3& h, Pixel pixel, oracle::Quad nearest) {
  oracle::Quad area = 0;
  for (const oracle::Polygon& p : oracle::clip(endless(h), pixel, oracle::Quad(1) / 2, nearest)) {
    area += oracle::area(p);
  }
  return static_cast<double>(area);
}

// Rounding the polygon's vertices and the truth to doubles: a perimeter of 4 times 2^-53, twice to be safe.
constexpr double kRounded = 1e-15;

double area_of(const Polygon& p) {
  double area = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const Vec2 a = p[i], b = p[i + 1 < p.size() ? i + 1 : 0];
    area += 0.5 * (a.x * b.y - b.x * a.y);
  }
  return area;
}

// The area of the even squares inside a polygon where W >= 0, by the better form of the series for a weight of 1. Never
// more than half the polygon's area from the truth, which is known beforehand.
BoxIntegral board_series(const LocalHomography& local, const Polygon& polygon, double max_pieces = 40000) {
  double area = 0, terms = 0, deepest = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 a = polygon[i], b = polygon[i + 1 < polygon.size() ? i + 1 : 0];
    area += 0.5 * (a.x * b.y - b.x * a.y);
    terms += 0.5 * (std::fabs(a.x * b.y) + std::fabs(b.x * a.y));
    deepest = std::max(deepest, row_at(local.w, a).value());
  }
  const double area_error = 16 * kUnit * terms;
  if (!(area > 0) || !(deepest > 0)) return {0.5 * std::max(area, 0.0), 0.5 * std::max(area, 0.0) + area_error};
  const double whole = area + area_error;
  constexpr double kOne[] = {1};
  const PieceWeight one{-1, 1, kOne, 1, 0};  // of a constant the rectangle means nothing
  CheckerSeries along_u(local.u, local.v, local.w, one, one, deepest),
      along_v(local.v, local.u, local.w, one, one, deepest);
  const SeriesAim aim{0x1p-50 * area, 0x1p-50 * area, max_pieces};
  along_u.lay_out(polygon, whole, aim);
  along_v.lay_out(polygon, whole, aim);
  const Bounded j = (along_u.estimate() <= along_v.estimate() ? along_u : along_v).integrate();
  // Known beforehand: between nothing and all.
  if (!(j.error < whole)) return {area / 2, whole / 2 + area_error};
  return {(area + j.value) / 2, (area_error + j.error) / 2 + kUnit * whole};
}

// By clipping in doubles, with its bound.
BoxIntegral clipped(BoardWindow window) {
  Boundary boundary;
  append_squares(window, boundary);
  double area = 0;
  for (const Segment& s : boundary.segments) area += s.weight * 0.5 * (s.a.x * s.b.y - s.b.x * s.a.y);
  // The sum of so many terms of the window's size.
  const double rounding = 0x1p-53 * static_cast<double>(boundary.segments.size());
  return {area, boundary.area_doubt() + rounding * 4 * window.half_width * window.half_width};
}

// A random camera's homography and a pixel so far below its horizon (pixels, negative: above).
struct View {
  Matrix3 h;
  Pixel pixel;
};
View random_view(Draw& draw, double rows) {
  const scenes::Camera c{draw.log_uniform(100, 2000), {draw.uniform(0, 1000), draw.uniform(0, 1000)},
                         draw.log_uniform(0.2, 20),   draw.uniform(-10, 60),
                         draw.uniform(-180, 180),     draw.uniform(-180, 180)};
  const Matrix3 h = matrix_of(scenes::homography_of(c));
  const double size = std::hypot(h[6], h[7]), nx = h[6] / size, ny = h[7] / size;
  const double down = rows - (h[6] * c.principal.x + h[7] * c.principal.y + h[8]) / size;
  const double along = draw.uniform(-1, 1) * c.focal;
  return {h,
          {static_cast<std::int64_t>(std::floor(c.principal.x + down * nx - along * ny)),
           static_cast<std::int64_t>(std::floor(c.principal.y + down * ny + along * nx))}};
}

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("the series agrees with 34 digits at 0.8 to 30 pixels below the horizon, any yaw and roll") {
    double worst = 0;
    for (const double yaw : {0.0, 7.0, 45.0})
      for (const double roll : {0.0, 15.0})
        for (const double height : {1.0, 8.0})
          for (const double rows : {0.8, 1.2, 2.7, 4.3, 8.0, 12.0, 30.0}) {
            const scenes::Camera c{
                .focal = 500, .principal = {}, .height = height, .pitch = 10, .yaw = yaw, .roll = roll};
            const Matrix3 h = matrix_of(scenes::homography_of(c));
            // The pixel whose centre is closest to that many rows below the horizon, at x = 40.5.
            const double y = rows * std::hypot(h[6], h[7]) / h[7] - (h[6] * 40.5 + h[8]) / h[7];
            const Pixel pixel{40, static_cast<std::int64_t>(std::floor(y))};
            const Polygon window = front(h, pixel, 0);
            const LocalHomography local = localize(h, pixel, 0.5);
            const double squares = squares_met(local, window);
            if (squares > 5000) continue;
            CAPTURE(yaw);
            CAPTURE(roll);
            CAPTURE(height);
            CAPTURE(rows);
            CAPTURE(squares);
            const BoxIntegral got = board_series(local, window);
            const double error = std::fabs(got.value - truth(h, pixel, 0));
            CHECK(error <= got.bound + kRounded);
            worst = std::max(worst, error);
            // With few squares (of tens of pixels) the series is not meant; where it is, this is its aim.
            if (squares > 50) CHECK(got.bound < 1e-12);
            // One-point perspective: nothing is truncated, and rounding is all, also for a single square.
            if (yaw == 0 && roll == 0) CHECK(got.bound < 1e-12);
          }
    MESSAGE("worst error " << worst);
  }

  TEST_CASE("the series agrees with 34 digits on what lies before a line close to the horizon") {
    Draw draw(41);
    double worst = 0, sum = 0;
    for (int i = 0; i < 60; ++i) {
      const View view = random_view(draw, draw.uniform(-0.5, 1));
      const LocalHomography local = localize(view.h, view.pixel, 0.5);
      // The line with some hundred squares before it.
      double low = 0, high = 1;
      for (int step = 0; step < 50; ++step) {
        const double mid = (low + high) / 2;
        const Polygon part = front(view.h, view.pixel, oracle::widen(mid));
        (part.size() < 3 || squares_met(local, part) <= 600 ? high : low) = mid;
      }
      const Polygon part = front(view.h, view.pixel, oracle::widen(high));
      if (part.size() < 3) continue;
      const BoxIntegral got = board_series(local, part);
      const double error = std::fabs(got.value - truth(view.h, view.pixel, oracle::widen(high)));
      CHECK(error <= got.bound + kRounded);
      CHECK(got.bound < 1e-11);
      worst = std::max(worst, error);
      sum += got.bound;
    }
    MESSAGE("worst error " << worst << ", mean bound " << sum / 60);
  }

  TEST_CASE("series and clipping agree within their bounds, on finite boards and far off as well") {
    Draw draw(42);
    int met = 0;
    for (int i = 0; i < 4000; ++i) {
      View view = random_view(draw, draw.log_uniform(0.3, 200));
      if (i % 3 == 0) {  // no camera: any plane
        for (std::size_t k = 0; k < 9; ++k) view.h[k] = draw.uniform(-1, 1) * (k == 6 || k == 7 ? 1e-3 : 1);
        view.pixel = {draw.integer(-2000, 2000), draw.integer(-2000, 2000)};
      }
      const double half = draw.log_uniform(0.1, 4);
      const LocalHomography local = localize(view.h, view.pixel, 0.5);
      const double u = local.u.c.value() / local.w.c.value(), v = local.v.c.value() / local.w.c.value();
      Extent extent;
      if (draw.coin()) {
        extent = {u - draw.log_uniform(0.1, 30), u + draw.log_uniform(0.1, 30), v - draw.log_uniform(0.1, 30),
                  v + draw.log_uniform(0.1, 30)};
        if (draw.coin()) extent = {std::floor(extent.u0), std::ceil(extent.u1), std::floor(extent.v0), extent.v1};
      }
      const BoardWindow window(local, extent, half);
      if (window.board.empty() || squares_met(local, window.board) > 3000) continue;
      ++met;
      const BoxIntegral series = board_series(local, window.board), squares = clipped(window);
      CAPTURE(i);
      CHECK(std::fabs(series.value - squares.value) <= series.bound + squares.bound);
    }
    CHECK(met > 1000);
  }

  TEST_CASE("what is left out towards the horizon is within its bound, where lines cross in step too") {
    // Columns at odd : odd multiples of the focal length from the vanishing point: both families of lines cross the
    // window's left side in step, and the tails do not cancel. The horizon is the side, a corner or the middle.
    double nearest = 0, largest = 0;
    for (const double height : {0.7, 1.0, 3.0})
      for (const double ratio : {1.0, 1.0 / 3, 1.0 / 5, 3.0 / 5, 0.0, 0.2137})
        for (const double row : {100.0, 100.5, 100.25, 101.0}) {
          const double focal = 300;
          const Matrix3 h = matrix_of(scenes::homography_of(level(focal, {20, row}, height)));
          const Pixel pixel{20 + static_cast<std::int64_t>(std::lround(ratio * focal)), 100};
          const LocalHomography local = localize(h, pixel, 0.5);
          const Polygon window = BoardWindow(local, {}, 0.5).board;
          if (window.empty()) continue;
          const BoxIntegral fine = board_series(local, window, 5000);
          for (const double pieces : {30.0, 500.0}) {
            CAPTURE(height);
            CAPTURE(ratio);
            CAPTURE(row);
            CAPTURE(pieces);
            const BoxIntegral coarse = board_series(local, window, pieces);
            CHECK(std::fabs(coarse.value - fine.value) <= coarse.bound + fine.bound);
            nearest = std::max(nearest, std::fabs(coarse.value - fine.value) / (coarse.bound + fine.bound));
            largest = std::max(largest, fine.bound);
          }
        }
    MESSAGE("largest difference over bound " << nearest << ", largest bound " << largest);
    CHECK(largest < 1e-9);
  }

  TEST_CASE("a side in short stretches is what it is from line to line, and as well known as foreseen") {
    // Boards so fine that a side meets thousands of lines, under weights of high degree, which one polynomial in W does
    // not follow along a side. The aims are out of reach, so that everything is done that can be.
    Draw draw(46);
    int cases = 0, better = 0;
    double worst = 0;
    for (int i = 0; i < 24; ++i) {
      View view = random_view(draw, i % 3 == 0 ? draw.uniform(-0.7, 0.7) : draw.log_uniform(0.5, 20));
      const double finer = draw.log_uniform(10, 1000);
      for (std::size_t k = 0; k < 6; ++k) view.h[k] *= finer;
      if (i % 2 == 1) {
        // Lines cross the left side in step, half a square apart: there E_1(u) s(v) has the mean 1/4. W is constant on
        // two sides, which some of these boards cross in more lines than are asked for.
        view = {{i % 4 == 3 ? 100 * finer : finer, 0.5, 8 * finer, 0, 0, 8 * finer, 0, 1, 0}, {0, 1 + i % 3}};
      }
      const LocalHomography local = localize(view.h, view.pixel, 0.5);
      std::vector<double> cx, cy;
      for (int k = 0; k <= 14; ++k) {
        cx.push_back(draw.uniform(-1, 1) * std::pow(0.3, k));
        cy.push_back(draw.uniform(-1, 1) * std::pow(0.3, k));
      }
      const PieceWeight x{-0.5, 0.5, cx, 2, 0}, y{-0.5, 0.5, cy, 2, 0};
      const BoardWindow window(local, {}, Rect{{x.low, y.low}, {x.high, y.high}});
      if (window.board.empty()) continue;
      double deepest = 0;
      for (const Vec2 p : window.board) deepest = std::max(deepest, row_at(local.w, p).value());
      const bool along_v = i % 4 == 3;
      CheckerSeries series(along_v ? local.v : local.u, along_v ? local.u : local.v, local.w, x, y, deepest);
      const double area = area_of(window.board) * (1 + 0x1p-40);
      series.lay_out(window.board, area, {1e-16, 1e-16, 100000});
      const Bounded lines = series.integrate();
      series.lay_out(window.board, area, {1e-16, 1e-16, 2000, true});
      const Bounded stretches = series.integrate();
      const SeriesOutlook outlook = series.outlook();
      CAPTURE(i);
      CAPTURE(finer);
      const double difference = std::fabs(stretches.value - lines.value), bounds = stretches.error + lines.error;
      CHECK(difference <= bounds);
      // Integrals may lose a quarter of the doubt more; rounding, of at most 1e-12 where a square is so small, and what
      // the estimate knows of are besides it.
      CHECK(stretches.error <= 1.5 * outlook.quick + series.estimate() + 1e-12);
      CHECK(outlook.doubt <= outlook.laid_out);
      CHECK(outlook.lines >= 0);  // was no number where W is constant along a side
      ++cases;
      better += stretches.error < 0.1 * outlook.laid_out;
      worst = std::max(worst, difference / bounds);
    }
    MESSAGE(better << " of " << cases << " known ten times better than as laid out; largest difference " << worst
                   << " of the bounds");
    CHECK(cases > 15);
    CHECK(better > 5);
  }

  TEST_CASE("a window on the horizon is known to 1e-11, and is not simply half of what is seen") {
    const Matrix3 h = matrix_of(scenes::homography_of(level(500, {20, 100}, 1)));
    double largest = 0;
    for (std::int64_t x = -200; x < 200; x += 40) {
      const LocalHomography local = localize(h, {x, 100}, 0.5);
      const BoxIntegral got = board_series(local, BoardWindow(local, {}, 0.5).board);
      CHECK(got.bound < 1e-11);
      largest = std::max(largest, std::fabs(got.value - 0.5) - got.bound);
    }
    MESSAGE("largest distance from one half, certainly " << largest);
    CHECK(largest > 1e-5);
  }
}

TEST_SUITE("heavy") {
  TEST_CASE("parts of a window add up, even and odd squares fill it, and u and v may be exchanged") {
    Draw draw(43);
    for (int i = 0; i < 40; ++i) {
      View view = random_view(draw, i % 4 == 0 ? draw.uniform(-0.7, 0.7) : draw.log_uniform(0.5, 20));
      // Multiples of 2^-40, so that rows can be added exactly.
      for (double& x : view.h) x = std::round(x * 0x1p40) * 0x1p-40;
      const LocalHomography local = localize(view.h, view.pixel, 0.5);
      const Polygon window = BoardWindow(local, {}, 0.5).board;
      if (window.empty()) continue;
      const double pieces = 1000;
      const BoxIntegral whole = board_series(local, window, pieces);
      CAPTURE(i);

      const double angle = draw.uniform(0, 7), c = draw.uniform(-0.3, 0.3);
      Polygon left, right;
      clip(window, {std::cos(angle), std::sin(angle), c}, left);
      clip(window, {-std::cos(angle), -std::sin(angle), -c}, right);
      const BoxIntegral a = board_series(local, left, pieces), b = board_series(local, right, pieces);
      CHECK(std::fabs(a.value + b.value - whole.value) <= a.bound + b.bound + whole.bound + kRounded);

      Matrix3 shifted = view.h, swapped = view.h;
      for (std::size_t k = 0; k < 3; ++k) {
        shifted[k] += view.h[6 + k];
        std::swap(swapped[k], swapped[3 + k]);
      }
      const BoxIntegral odd = board_series(localize(shifted, view.pixel, 0.5), window, pieces);
      CHECK(std::fabs(whole.value + odd.value - area_of(window)) <= whole.bound + odd.bound + kRounded);
      const BoxIntegral other = board_series(localize(swapped, view.pixel, 0.5), window, pieces);
      CHECK(std::fabs(whole.value - other.value) <= whole.bound + other.bound);
    }
  }

  TEST_CASE("by parts along u and along v is the same under any weight, on the horizon too") {
    // Two formulas with hardly a number in common, from the g_j to the integrals towards the horizon.
    Draw draw(45);
    int close = 0, cases = 0;
    double worst = 0;
    for (int i = 0; i < 80; ++i) {
      const View view = random_view(draw, i % 2 == 0 ? draw.uniform(-0.7, 0.7) : draw.log_uniform(0.5, 5));
      const LocalHomography local = localize(view.h, view.pixel, 0.5);
      // Smooth weights: coefficients fall.
      const int degree = static_cast<int>(draw.integer(0, 9));
      std::vector<double> cx, cy;
      for (int k = 0; k <= degree; ++k) {
        cx.push_back(draw.uniform(-1, 1) * std::pow(0.3, k));
        cy.push_back(draw.uniform(-1, 1) * std::pow(0.3, k));
      }
      const double x0 = draw.uniform(-1.5, 0), y0 = draw.uniform(-1.5, 0);
      const PieceWeight x{x0, x0 + draw.uniform(0.3, 1.5), cx, 2, 0}, y{y0, y0 + draw.uniform(0.3, 1.5), cy, 2, 0};
      const BoardWindow window(local, {}, Rect{{x.low, y.low}, {x.high, y.high}});
      if (window.board.empty() || squares_met(local, window.board) < 20) continue;
      double deepest = 0;
      for (const Vec2 p : window.board) deepest = std::max(deepest, row_at(local.w, p).value());
      CheckerSeries along_u(local.u, local.v, local.w, x, y, deepest),
          along_v(local.v, local.u, local.w, x, y, deepest);
      const double area = area_of(window.board) * (1 + 0x1p-40);
      const SeriesAim aim{1e-14, 1e-11, 5000};
      along_u.lay_out(window.board, area, aim);
      along_v.lay_out(window.board, area, aim);
      const Bounded u = along_u.integrate(), v = along_v.integrate();
      CAPTURE(i);
      CAPTURE(degree);
      CHECK(std::fabs(u.value - v.value) <= u.error + v.error);
      ++cases;
      if (!(u.error + v.error < 1e-9)) continue;
      ++close;
      worst = std::max(worst, std::fabs(u.value - v.value));
    }
    MESSAGE(close << " of " << cases << " known to 1e-9 in both ways; largest difference there " << worst);
    CHECK(cases > 50);
    CHECK(close > 20);
  }
}

TEST_SUITE("slow") {
  TEST_CASE("the series agrees with 34 digits on 2000 random windows with up to 20000 squares") {
    Draw draw(44);
    double worst = 0;
    int met = 0;
    while (met < 2000) {
      const View view = random_view(draw, draw.log_uniform(0.55, 60));
      const LocalHomography local = localize(view.h, view.pixel, 0.5);
      const Polygon window = front(view.h, view.pixel, 0);
      if (window.size() < 3 || area_of(window) < 1 || !(squares_met(local, window) < 20000)) continue;
      ++met;
      const BoxIntegral got = board_series(local, window);
      const double error = std::fabs(got.value - truth(view.h, view.pixel, 0));
      CHECK(error <= got.bound + kRounded);
      worst = std::max(worst, error / (got.bound + kRounded));
    }
    MESSAGE("largest error over bound " << worst);
  }
}

}  // namespace moire
