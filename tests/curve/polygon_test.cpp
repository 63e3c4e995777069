// Clipping convex polygons: areas add up, and what must be exact is exact.
#include <doctest/doctest.h>

#include <cmath>
#include <random>

#include "curve/polygon.h"

using namespace moire;

namespace {

double area(const Polygon& p) {
  double sum = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const Vec2 a = p[i], b = p[(i + 1) % p.size()];
    sum += 0.5 * (a.x * b.y - b.x * a.y);
  }
  return sum;
}

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("the square is oriented so that its area is positive") { CHECK(area(square(0.5)) == 1.0); }

  TEST_CASE("the two parts that a line leaves add up to the whole") {
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> angle(0, 6.3), offset(-1.2, 1.2);
    Polygon in, out, piece;
    for (int i = 0; i < 2000; ++i) {
      const double a = angle(random), c = offset(random);
      clip(square(1), {std::cos(a), std::sin(a), c}, in);
      clip(square(1), {-std::cos(a), -std::sin(a), -c}, out);
      // A few roundings of vertices of size 1 on sides of length 2.
      CHECK(std::fabs(area(in) + area(out) - 4) <= 64 * 0x1p-53);
      for (const Vec2 p : in) {
        CHECK(std::cos(a) * p.x + std::sin(a) * p.y + c >= -16 * 0x1p-53);
        const bool on_side = std::fabs(p.x) == 1 || std::fabs(p.y) == 1;
        CHECK(on_side);  // exactly: vertices keep the coordinate of the side they were cut from
      }
      CHECK(perimeter(in) <= 8 + 1e-12);
    }
  }

  TEST_CASE("lines beside, along and through corners have defined answers") {
    Polygon out;
    clip(square(1), {1, 0, 2}, out);
    CHECK(out.size() == 4);
    clip(square(1), {1, 0, -2}, out);
    CHECK(out.empty());
    clip(square(1), {1, 0, -1}, out);  // touches the side x = 1
    CHECK(area(out) == 0);
    clip(square(1), {1, 0, 1}, out);  // along the side x = -1
    CHECK(area(out) == 4);
    clip(square(1), {1, -1, 0}, out);  // through two corners
    CHECK(area(out) == 2);
    clip(Polygon{}, {1, 0, 0}, out);
    CHECK(out.empty());
  }
}
