// Box values by their own ways (HasBoxIntegral) against the general boundary integral, which they bypass, and against
// the oracle, where lines are placed to hurt: through corners, along sides, almost parallel, meeting in the window, far
// from the origin, near the horizon, beside the board's rim.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/error.h"
#include "engine/boundary_integral.h"
#include "engine/exact_compare.h"
#include "engine/random_scenes.h"
#include "testimages/board_box.h"

namespace moire {
namespace {

constexpr double kBoxTolerance = 1e-13;  // what moire promises for the box

// Both ways and the oracle, case by case.
class BoxComparison {
 public:
  explicit BoxComparison(const std::string& box) : filter_(parse_spec(box, "test")), oracle_(box, kBoxTolerance) {}

  double radius() const { return filter_.radius(); }

  void operator()(const RandomCase& c) {
    oracle_(c.image, c.pixel);
    const double h = filter_.radius(), area = 4 * h * h;
    const std::optional<BoxIntegral> quick = c.image.box_integral(c.pixel, h);
    if (!quick) return;
    ++quick_;
    Boundary boundary;
    c.image.boundary(c.pixel, h, boundary);
    const Kernel& kernel = filter_.kernel();
    BoundaryIntegral integral(kernel);
    for (const Segment& s : boundary.segments) integral.add(s);
    const double general = integral.bound() + boundary.area_doubt() * kernel.k_max() * kernel.k_max();
    // 4 u for the quotient and for the area here.
    const double difference = std::fabs(quick->value / area - integral.value());
    CHECK(difference <= quick->bound / area + general + 4 * 0x1p-53);
    CHECK(quick->value >= 0);
    CHECK(quick->value <= area);
    largest_ = std::max(largest_, quick->bound / area);
    worst_ = std::max(worst_, difference);
  }

  // Cases that had a way of their own, and how many they were meant to be.
  void report(int expected) {
    MESSAGE(oracle_.summary(), "; ", quick_, " with a way of their own: bounds up to ", largest_,
            ", from the boundary integral by up to ", worst_);
    CHECK(quick_ >= expected);
  }
  double largest_bound() const { return largest_; }

 private:
  Filter filter_;
  ExactComparison oracle_;
  int quick_ = 0;
  double largest_ = 0, worst_ = 0;
};

// A direction that is on an axis or a diagonal, within 1e-16 to 1e-3 of one, or any.
Vec2 hard_direction(Draw& draw) {
  const double angle = draw.uniform(0, 2 * std::numbers::pi), turn = draw.coin() ? 0 : draw.log_uniform(1e-16, 1e-3);
  const double side = draw.coin() ? 1 : -1;
  switch (draw.integer(0, 3)) {
    case 0:
      return {side, turn};
    case 1:
      return {turn, side};
    case 2:
      return {1, side + turn};
    default:
      return {std::cos(angle), std::sin(angle)};
  }
}

// A corner, the middle of a side or any point of the window, sometimes off it by 1e-16 to 1e-9; from its centre.
Vec2 hard_point(Draw& draw, double h) {
  const auto coordinate = [&] {
    const double off = draw.coin() ? 0 : draw.log_uniform(1e-16, 1e-9) * (draw.coin() ? 1 : -1);
    return draw.integer(0, 2) == 0 ? draw.uniform(-h, h) : h * static_cast<double>(draw.integer(-1, 1)) + off;
  };
  return {coordinate(), coordinate()};
}

// Now and then 2^20 or 2^40 pixels away.
Pixel hard_pixel(Draw& draw) {
  const std::int64_t far = std::int64_t{1} << 20 * draw.integer(0, 2);
  const std::int64_t reach = draw.coin() ? far : 0;
  return {draw.integer(-4, 4) + reach, draw.integer(-4, 4) - reach};
}

Vec2 centre(Pixel p) { return {static_cast<double>(p.x) + 0.5, static_cast<double>(p.y) + 0.5}; }

RandomCase hard_edge(Draw& draw, double h) {
  const Pixel pixel = hard_pixel(draw);
  const Vec2 at = hard_point(draw, h), c = centre(pixel), n = hard_direction(draw);
  const double length = draw.log_uniform(1e-6, 1e6);
  return {scenes::edge({c.x + at.x, c.y + at.y}, {n.x * length, n.y * length}), pixel};
}

// A line u = k and a line v = l, each through a hard point in a hard direction, sometimes the same point, sometimes
// almost the same direction; up to a few lines of each family; W from constant to a horizon next to the window.
std::optional<RandomCase> try_hard_board(Draw& draw, double h) {
  const Pixel pixel = hard_pixel(draw);
  const Vec2 c = centre(pixel), p = hard_point(draw, h), q = draw.integer(0, 2) == 0 ? p : hard_point(draw, h);
  const Vec2 n = hard_direction(draw);
  Vec2 m = hard_direction(draw);
  if (draw.integer(0, 3) == 0) {
    const double turn = draw.log_uniform(1e-6, 1e-1);
    m = {n.x - turn * n.y, n.y + turn * n.x};
  }
  // W = 1 at the centre and 0 at `distance` along some direction.
  const double distance = draw.coin() ? HUGE_VAL : h * draw.log_uniform(1.42, 1000);
  const double angle = draw.uniform(0, 2 * std::numbers::pi);
  const Vec2 g{std::cos(angle) / distance, std::sin(angle) / distance};
  const auto k = static_cast<double>(draw.integer(-300, 300)), l = static_cast<double>(draw.integer(-300, 300));
  const double su = draw.log_uniform(0.01, 2) / h, sv = draw.log_uniform(0.01, 2) / h;
  const double w0 = 1 - g.x * c.x - g.y * c.y;
  const auto row = [&](Vec2 normal, double s, Vec2 at, double number) {
    const double a = s * normal.x + number * g.x, b = s * normal.y + number * g.y;
    return std::array{a, b, number * w0 - s * normal.x * (c.x + at.x) - s * normal.y * (c.y + at.y)};
  };
  const auto u = row(n, su, p, k), v = row(m, sv, q, l);
  const std::vector<double> matrix{u[0], u[1], u[2], v[0], v[1], v[2], g.x, g.y, w0};
  // The rim in whole numbers or not, along one of those lines or through the window or beyond it.
  const auto rim = [&](double line) {
    const double out = draw.integer(0, 2) == 0 ? 0 : draw.log_uniform(0.1, 10);
    return draw.coin() ? line + std::floor(out) : line + out;
  };
  const std::vector<double> extent{-rim(-k), rim(k + 1), -rim(-l), rim(l + 1)};
  try {
    if (draw.coin()) return RandomCase{scenes::board(matrix, extent), pixel};
    return RandomCase{scenes::plane(matrix), pixel};
  } catch (const Error&) {
    return std::nullopt;  // singular: parallel after rounding, far from the origin
  }
}

RandomCase hard_board(Draw& draw, double h) {
  for (;;) {
    if (const auto c = try_hard_board(draw, h)) return *c;
  }
}

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("edges through corners, along sides and far away: box values by cases, the boundary and the oracle agree") {
    for (const char* box : {"box", "box:width=3"}) {
      Draw draw(31);
      BoxComparison compare(box);
      for (int i = 0; i < 10000; ++i) compare(hard_edge(draw, compare.radius()));
      compare.report(10000);
      // doubt 2 h / p = 16 u h^2, and 14 u h^2 at most for the roundings; 2^-100 of coordinates up to 2^40 is nothing.
      CHECK(compare.largest_bound() <= 7.51 * 0x1p-53);
    }
  }

  TEST_CASE("boards with lines placed to hurt: box values cut in doubles, the boundary and the oracle agree") {
    for (const char* box : {"box", "box:width=3"}) {
      Draw draw(32);
      BoxComparison compare(box);
      for (int i = 0; i < 10000; ++i) compare(hard_board(draw, compare.radius()));
      // What is left comes next to the horizon, or where double-double itself has lost the lines, far away.
      compare.report(7500);
    }
  }

  TEST_CASE("random boards: nearly all windows of few squares are cut in doubles, within their bounds") {
    Draw draw(33);
    BoxComparison compare("box");
    for (int i = 0; i < 10000; ++i) compare(random_board(draw, compare.radius(), 30));
    compare.report(9500);
    CHECK(compare.largest_bound() <= kPlainBound);
  }

  TEST_CASE("a window of three pixels by three holds what its nine pixels hold, whichever way each is found") {
    Draw draw(34);
    const Filter box(parse_spec("box", "test"));
    int compared = 0;
    for (int i = 0; i < 3000; ++i) {
      const RandomCase c = i % 2 == 0 ? random_board(draw, 1.5, 60) : random_edge(draw, 1.5);
      const std::optional<BoxIntegral> wide = c.image.box_integral(c.pixel, 1.5);
      if (!wide) continue;
      ++compared;
      double sum = 0, bound = wide->bound;
      for (int k = 0; k < 9; ++k) {
        const Exact part = exact_pixel(c.image, box, {c.pixel.x + k % 3 - 1, c.pixel.y + k / 3 - 1});
        sum += part.value;
        bound += part.bound;
      }
      CHECK(std::fabs(sum - wide->value) <= bound + 9 * 9 * 0x1p-53);  // the sum here: 9 roundings of 9 at most
    }
    CHECK(compared > 2500);
  }
}

}  // namespace moire
