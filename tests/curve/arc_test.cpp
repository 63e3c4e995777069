// Quarters of circles against 34 digits: points on pieces, where knots are passed, corners that meet.
#include "curve/arc.h"

#include <doctest/doctest.h>

#include <cmath>
#include <random>

#include "core/rounding.h"

namespace moire {
namespace {

using Quad = __float128;

Quad magnitude(Quad x) { return x < 0 ? -x : x; }
Quad root(Quad x) {
  Quad r = Quad(std::sqrt(static_cast<double>(x)));
  for (int i = 0; i < 3 && r > 0; ++i) r = (r + x / r) / 2;
  return r;
}

constexpr Quarter kQuarters[] = {Quarter::left, Quarter::upper, Quarter::right, Quarter::lower};

// Radius log-uniform from 1e-6 to 1e12; passes within 1 of the origin.
Circle random_circle(std::mt19937_64& random) {
  std::uniform_real_distribution<double> unit(-1, 1), power(-6, 12), angle(0, 6.2831853);
  const double r = std::pow(10, power(random)), a = angle(random);
  const Dd x = Dd(unit(random)) - two_prod(r, std::cos(a)), y = Dd(unit(random)) - two_prod(r, std::sin(a));
  return {{x.hi, y.hi}, {x.lo, y.lo}, r, (two_prod(r, r) - x * x - y * y).value()};
}

// The running coordinate of parameter v.
Quad run_at(const Arc& arc, double v) { return (arc.near ? Quad(arc.c_run) + Quad(arc.rest_run) : Quad(0)) + Quad(v); }

// The other coordinate at run, on the quarter's side.
Quad other_at(const Arc& arc, Quad run) {
  const Quad beta = run - Quad(arc.c_run) - Quad(arc.rest_run), r = Quad(arc.circle.radius);
  return Quad(arc.c_other) + Quad(arc.rest_other) + Quad(arc.side) * root((r - beta) * (r + beta));
}

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("points beside a piece's middle are right to the rounding of their coordinates") {
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> unit(-1, 1);
    int met = 0;
    for (int round = 0; round < 20000; ++round) {
      const Circle c = random_circle(random);
      const Arc arc = quarter(c, kQuarters[random() % 4], c.radius <= 8);
      const double low = std::max(arc.v0, arc.v_of(-2)), high = std::min(arc.v1, arc.v_of(2));
      if (!(low < high)) continue;
      const double mid = 0.5 * (low + high), tau = unit(random) * 0.5 * (high - low);
      const ArcMiddle::Point p = ArcMiddle(arc, mid).at(tau);
      const Quad run = run_at(arc, mid) + Quad(tau);
      CHECK(magnitude(Quad(p.run) - run) <= Quad(kUnit * (std::fabs(p.run) + std::fabs(tau)) + 0x1p-98 * c.radius));
      const double bound = kUnit * (std::fabs(p.other) + 8 * std::fabs(tau)) + 0x1p-98 * c.radius;
      CHECK(magnitude(Quad(p.other) - other_at(arc, run)) <= Quad(bound));
      ++met;
    }
    CHECK(met > 5000);
  }

  TEST_CASE("where a quarter passes a coordinate is right to 24 roundings of the window") {
    std::mt19937_64 random(2);
    std::uniform_real_distribution<double> unit(-2, 2);
    int met = 0;
    for (int round = 0; round < 20000; ++round) {
      const Circle c = random_circle(random);
      const Arc arc = quarter(c, kQuarters[random() % 4], c.radius <= 8);
      const double at = unit(random);
      const auto passes = arc.passes(at);
      for (const double v : {passes[1], passes[2]}) {
        if (!(v >= arc.v0 && v <= arc.v1)) continue;
        const Quad run = run_at(arc, v);
        if (magnitude(run) > 2) continue;
        CHECK(magnitude(other_at(arc, run) - Quad(at)) <= Quad(24 * kUnit * 2 + 0x1p-98 * c.radius));
        ++met;
      }
    }
    CHECK(met > 1000);
  }

  TEST_CASE("quarters meet at their corners, and rectangles hold them") {
    std::mt19937_64 random(3);
    for (int round = 0; round < 5000; ++round) {
      const Circle c = random_circle(random);
      const bool near = c.radius <= 8;
      const Arc left = quarter(c, Quarter::left, near), upper = quarter(c, Quarter::upper, near);
      const Arc right = quarter(c, Quarter::right, near), lower = quarter(c, Quarter::lower, near);
      CHECK(left.run(left.v0) == upper.other(upper.v0));
      CHECK(left.other(left.v0) == upper.run(upper.v0));
      CHECK(right.run(right.v1) == lower.other(lower.v1));
      CHECK(right.other(right.v1) == lower.run(lower.v1));
      CHECK(right.run(right.v0) == upper.other(upper.v1));
      CHECK(left.other(left.v1) == lower.run(lower.v0));
      for (const Quarter which : kQuarters) {
        const Arc arc = quarter(c, which, near);
        const Rect r = around(c, which);
        for (const double share : {0.0, 0.3, 0.5, 1.0}) {
          const double v = arc.v0 + share * (arc.v1 - arc.v0), run = arc.run(v), other = arc.other(v);
          const double x = arc.upright ? other : run, y = arc.upright ? run : other;
          CHECK((x >= r.lo.x && x <= r.hi.x && y >= r.lo.y && y <= r.hi.y));
        }
      }
    }
  }
}

}  // namespace moire
