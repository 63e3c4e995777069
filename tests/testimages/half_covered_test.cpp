// Bounds on what a board's squares and half of everything differ by under a weight, against every square clipped and
// integrated.
#include "testimages/half_covered.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include "curve/quadrature.h"
#include "engine/random_scenes.h"
#include "testimages/board_squares.h"

namespace moire {
namespace {

constexpr double kRadius = 1.5;

struct Weight {
  std::string name;
  std::function<double(Vec2)> g;
  WeightBounds bounds;
};

// With their bounds by hand; sigma = 1/2, so that slopes are at most 2 exp(-1/2) and second derivatives 4.
std::vector<Weight> weights() {
  constexpr double R = kRadius;
  const double slope = 2 * std::exp(-0.5), rim = std::exp(-2 * R * R);
  const auto gauss = [](Vec2 p) { return std::exp(-2 * (p.x * p.x + p.y * p.y)); };
  std::vector<Weight> out;
  out.push_back({"gaussian", gauss, {.top = 1, .rim = rim, .slope = slope, .curvature = 4}});
  out.push_back({"gaussian beyond a line",
                 [gauss](Vec2 p) { return p.x + 0.3 * p.y > 0.1 ? gauss(p) : 0.0; },
                 {.top = 1, .rim = rim, .jump = 1, .slope = slope, .kink = slope, .curvature = 4}});
  out.push_back({"cone",
                 [](Vec2 p) { return std::max(0.0, 1 - std::hypot(p.x, p.y) / R); },
                 {.top = 1, .slope = 1 / R, .kink = 1 / R, .pole = 1 / R}});
  // (1 - s^2)^2, s = r / R: slope 4 s (1 - s^2) / R, largest at s^2 = 1/3; second derivatives 4 (3 s^2 - 1) / R^2 along
  // r and -4 (1 - s^2) / R^2 across.
  out.push_back({"bump",
                 [](Vec2 p) {
                   const double s = (p.x * p.x + p.y * p.y) / (R * R);
                   return s < 1 ? (1 - s) * (1 - s) : 0.0;
                 },
                 {.top = 1, .slope = 8 / (3 * std::numbers::sqrt3 * R) * (1 + 1e-15), .curvature = 8 / (R * R)}});
  out.push_back({"constant", [](Vec2) { return 1.0; }, {.top = 1, .rim = 1}});
  return out;
}

// The integral of g over a convex polygon: a fan of triangles, each a square with one side drawn together.
double integral(const Polygon& polygon, const std::function<double(Vec2)>& g, int nodes) {
  const Rule rule = gauss_legendre(nodes);
  double sum = 0;
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
    const Vec2 a = polygon[0], b = polygon[i], c = polygon[i + 1];
    const double area = (b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y);
    if (area == 0) continue;
    for (std::size_t m = 0; m < rule.node.size(); ++m) {
      const double s = 0.5 + 0.5 * rule.node[m];
      for (std::size_t n = 0; n < rule.node.size(); ++n) {
        const double t = 0.5 + 0.5 * rule.node[n], x = s * (1 - t), y = s * t;
        sum += 0.25 * rule.weight[m] * rule.weight[n] * s * area *
               g({a.x + x * (b.x - a.x) + y * (c.x - a.x), a.y + x * (b.y - a.y) + y * (c.y - a.y)});
      }
    }
  }
  return sum;
}

struct Truth {
  double value = 0, error = 0;
};

// The integral of g (density - 1/2), square by square. The error is what two rules differ by.
Truth brute(const LocalHomography& local, const Polygon& polygon, const Weight& weight) {
  const auto range = [&](const LocalHomography::Row& r, const Polygon& p) {
    double low = HUGE_VAL, high = -HUGE_VAL;
    for (const Vec2 q : p) {
      const double f = (r.a * q.x + r.b * q.y + r.c.value()) / (local.w.a * q.x + local.w.b * q.y + local.w.c.value());
      low = std::min(low, f), high = std::max(high, f);
    }
    return std::pair{std::floor(low), std::floor(high)};
  };
  const auto beyond = [&](const LocalHomography::Row& r, double k, double sign) {
    const BoardLine line = board_line(r, local.w, k, sign);
    return line.plane;
  };
  Polygon above, strip, right, cell;
  Truth truth;
  const auto [bottom, top] = range(local.v, polygon);
  for (double l = bottom; l <= top; ++l) {
    clip(polygon, beyond(local.v, l, 1), above);
    clip(above, beyond(local.v, l + 1, -1), strip);
    if (strip.size() < 3) continue;
    const auto [first, last] = range(local.u, strip);
    for (double k = first; k <= last; ++k) {
      clip(strip, beyond(local.u, k, 1), right);
      clip(right, beyond(local.u, k + 1, -1), cell);
      if (cell.size() < 3) continue;
      const double fine = integral(cell, weight.g, 8), coarse = integral(cell, weight.g, 6);
      truth.value += even_square(k, l) ? 0.5 * fine : -0.5 * fine;
      truth.error += std::fabs(fine - coarse);
    }
  }
  return truth;
}

struct Sample {
  LocalHomography local;
  SharpPolygon part;
  MiddleLine middle;
};

// A strip of the window with up to so many squares, cut off along a middle line or anywhere.
Sample random_strip(Draw& draw, double squares) {
  for (;;) {
    const scenes::Camera camera{.focal = draw.log_uniform(100, 2000),
                                .principal = {0, 0},
                                .height = draw.log_uniform(0.2, 20),
                                .pitch = draw.uniform(-10, 60),
                                .yaw = draw.uniform(-180, 180),
                                .roll = draw.coin() ? 0 : draw.uniform(-45, 45)};
    const std::vector<double> h = scenes::homography_of(camera);
    const double size = std::hypot(h[6], h[7]), rows = draw.uniform(-1, 8), along = draw.uniform(-1, 1) * camera.focal;
    const double nx = h[6] / size, ny = h[7] / size, down = -h[8] / size + rows;
    const Pixel pixel{static_cast<std::int64_t>(std::floor(down * nx - along * ny)),
                      static_cast<std::int64_t>(std::floor(down * ny + along * nx))};
    Matrix3 matrix{};
    std::copy(h.begin(), h.end(), matrix.begin());
    const LocalHomography local = localize(matrix, pixel, 0.5);
    BoardWindow window(local, Extent{}, kRadius);
    double deepest = 0;
    Vec2 deep;
    for (const Vec2 p : window.board) {
      const double w = local.w.a * p.x + local.w.b * p.y + local.w.c.value();
      if (w > deepest) deepest = w, deep = p;
    }
    if (!(deepest > 0)) continue;
    const double near = deepest * draw.uniform(0.2, 1), far = near * draw.uniform(0.05, 0.9);
    const LocalHomography::Row& w = local.w;
    Sample out{local, {}, {}};
    SharpPolygon front, back;
    const int slot = BoardWindow::kCut;
    window.clipper.set_line(slot, sharp_line({w.a, w.b, w.c - Dd(far), w.c_error}, w, 0, 1));
    window.clipper.split(window.part, slot, &front, nullptr);
    if (draw.coin()) {
      window.clipper.set_line(slot + 1, sharp_line({w.a, w.b, w.c - Dd(near), w.c_error}, w, 0, 1));
      window.clipper.split(front, slot + 1, nullptr, &out.part);
    } else {
      const bool of_u = draw.coin();
      const LocalHomography::Row& row = of_u ? local.u : local.v;
      // Through a random point; the side away from the deepest corner.
      const Vec2 p{draw.uniform(-1, 1), draw.uniform(-1, 1)};
      const auto at = [&](Vec2 q) {
        return (row.a * q.x + row.b * q.y + row.c.value()) / (w.a * q.x + w.b * q.y + w.c.value());
      };
      if (!(std::fabs(at(p)) < 1e9)) continue;
      out.middle = {slot + 1, of_u, std::floor(at(p)) + 0.5};
      window.clipper.set_line(slot + 1, sharp_line(row, w, out.middle.at, at(deep) > out.middle.at ? 1 : -1));
      window.clipper.split(front, slot + 1, nullptr, &out.part);
    }
    Polygon rounded;
    for (std::size_t i = 0; i < out.part.size(); ++i) rounded.push_back(out.part.at(i));
    const double met = squares_met(local, rounded);
    if (rounded.size() > 2 && met > 20 && met < squares) return out;
  }
}

TEST_SUITE("unit") {
  TEST_CASE("squares and half of everything differ by no more than the bounds of first and second order") {
    Draw draw(50);
    const std::vector<Weight> all = weights();
    std::vector<double> shares;  // of half the area; smooth weights over many squares
    double tightest = 0;
    for (int n = 0; n < 600; ++n) {
      const Sample sample = random_strip(draw, n % 4 == 0 ? 8000 : 1000);
      Polygon polygon;
      for (std::size_t i = 0; i < sample.part.size(); ++i) polygon.push_back(sample.part.at(i));
      const Unresolved unresolved = half_covered(sample.local, sample.part, sample.middle);
      REQUIRE(unresolved.known == 4);
      const Weight& weight = all[static_cast<std::size_t>(n) % all.size()];
      const Truth truth = brute(sample.local, polygon, weight);
      CAPTURE(weight.name);
      CAPTURE(n);
      // Every order is a bound, and rounding of clipped squares is below 1e-13 of the window.
      for (int order = 0; order < 4; ++order) {
        Unresolved one{
            .area = unresolved.area, .orders = {unresolved.orders[static_cast<std::size_t>(order)]}, .known = 1};
        CAPTURE(order);
        CHECK(std::fabs(truth.value) <= one.bound(weight.bounds) + truth.error + 1e-12);
      }
      tightest = std::max(tightest, (std::fabs(truth.value) - truth.error) / unresolved.bound(weight.bounds));
      if (weight.bounds.jump == 0 && squares_met(sample.local, polygon) > 2000) {
        shares.push_back(unresolved.bound(weight.bounds) / unresolved.area);
      }
    }
    std::sort(shares.begin(), shares.end());
    REQUIRE(shares.size() > 20);
    MESSAGE(shares.size() << " bounds as a share of half the area: least " << shares.front() << ", median "
                          << shares[shares.size() / 2] << "; the largest error is " << tightest << " of its bound");
    CHECK(shares[shares.size() / 2] < 0.1);
    CHECK(tightest > 0.02);
  }

  TEST_CASE("what is unknown of a weight leaves the bound by area") {
    Unresolved u{.area = 0.5, .orders = {}, .known = 1};
    u.orders[0] = {.top = 0, .slope = 1e-3, .curvature = 1e-6};
    CHECK(u.bound({.top = 2, .curvature = HUGE_VAL}) == 1);
    CHECK(u.bound({.top = 2, .slope = 3, .kink = HUGE_VAL, .curvature = 5}) == doctest::Approx(3e-3 + 5e-6));
    CHECK(Unresolved{.area = 0.5, .orders = {}}.bound({.top = 2}) == 1);
  }
}

}  // namespace
}  // namespace moire
