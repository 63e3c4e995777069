// Cutting in more than double precision: every vertex against the meet of its two lines in 34 digits.
#include "curve/sharp_polygon.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace moire {
namespace {

using Quad = __float128;

Quad exact(Dd x) { return Quad(x.hi) + Quad(x.lo); }
Quad magnitude(Quad x) { return x < 0 ? -x : x; }

// A line through the window at any angle; now and then within 1e-15 to 1e-3 of an axis, of a diagonal or of `near`.
SharpLine random_line(std::mt19937_64& random, double h, const SharpLine& near) {
  std::uniform_real_distribution<double> unit(-1, 1), power(-15, -3);
  const double turn = std::pow(10, power(random)), at = h * unit(random);
  Dd a = unit(random), b = unit(random);
  switch (random() % 6) {
    case 0:
      a = 1, b = turn;
      break;
    case 1:
      a = -turn, b = 1;
      break;
    case 2:
      a = 1, b = 1 + turn;
      break;
    case 3:
      a = near.a, b = near.b + Dd(turn);
      break;
    default:
      break;
  }
  // More digits than a double has, as the lines of a board have them.
  a = a + Dd(unit(random) * 0x1p-60);
  return {a, b, -(a * Dd(at) + b * Dd(h * unit(random)))};
}

Quad area(const SharpPolygon& p) {
  Quad sum = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const SharpVertex a = p[i], b = p[i + 1 < p.size() ? i + 1 : 0];
    const Quad ax = Quad(a.at.x) + Quad(a.rest.x), ay = Quad(a.at.y) + Quad(a.rest.y);
    const Quad bx = Quad(b.at.x) + Quad(b.rest.x), by = Quad(b.at.y) + Quad(b.rest.y);
    sum += (ax * by - bx * ay) / 2;
  }
  return sum;
}

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("vertices lie on both their lines to 2^-70 of the window, and parts add up to it") {
    std::mt19937_64 random(1);
    for (const double h : {0.5, 2.0, 4.5}) {
      for (int round = 0; round < 3000; ++round) {
        SharpClipper clipper(h);
        std::vector<SharpLine> lines{{0, 1, h}, {-1, 0, h}, {0, -1, h}, {1, 0, h}};
        SharpPolygon rest = clipper.window(), front, back;
        Quad total = 0;
        for (int slot = SharpClipper::kWindow; slot < SharpClipper::kWindow + 4; ++slot) {
          lines.push_back(random_line(random, h, lines.back()));
          clipper.set_line(slot, lines.back());
          clipper.split(rest, slot, &front, &back);
          for (const SharpPolygon* part : {&front, &back}) {
            for (std::size_t i = 0; i < part->size(); ++i) {
              // On the line of the side before it and of the side after it.
              const SharpVertex v = (*part)[i];
              for (const int side : {v.side, (*part)[i > 0 ? i - 1 : part->size() - 1].side}) {
                const SharpLine& l = lines[static_cast<std::size_t>(side)];
                const Quad value = exact(l.a) * (Quad(v.at.x) + Quad(v.rest.x)) +
                                   exact(l.b) * (Quad(v.at.y) + Quad(v.rest.y)) + exact(l.c);
                CHECK(magnitude(value) <= Quad(0x1p-69 * h) * (magnitude(exact(l.a)) + magnitude(exact(l.b))));
              }
              CHECK(std::max(std::fabs(v.at.x), std::fabs(v.at.y)) <= h);
              CHECK(std::fabs(v.rest.x) <= 0x1p-53 * std::fabs(v.at.x));
            }
          }
          total += area(back);
          rest = front;
        }
        // Each cut's two parts share their new vertices; what is lost is a sliver that has fewer than three.
        CHECK(magnitude(total + area(rest) - Quad(4 * h * h)) <= Quad(0x1p-64 * h * h));
        CHECK(clipper.area_error() <= 0x1p-60 * h * h);
      }
    }
  }

  TEST_CASE("vertices on the window's sides keep their side's coordinate exactly, and sides there are in no doubt") {
    std::mt19937_64 random(2);
    for (int round = 0; round < 3000; ++round) {
      SharpClipper clipper(1.5);
      SharpPolygon part;
      clipper.set_line(SharpClipper::kWindow, random_line(random, 1.5, {1, 1, 0}));
      clipper.split(clipper.window(), SharpClipper::kWindow, &part, nullptr);
      Boundary boundary;
      SharpClipper::append(part, 1, boundary);
      for (const Segment& s : boundary.segments) {
        const bool on_window =
            (s.a.x == s.b.x && std::fabs(s.a.x) == 1.5) || (s.a.y == s.b.y && std::fabs(s.a.y) == 1.5);
        CHECK((s.doubt == 0) == on_window);
      }
    }
  }

  TEST_CASE("lines beside, along and through corners have defined answers") {
    SharpClipper clipper(1);
    SharpPolygon front, back;
    const auto split = [&](SharpLine l) {
      clipper.set_line(SharpClipper::kWindow, l);
      clipper.split(clipper.window(), SharpClipper::kWindow, &front, &back);
    };
    split({1, 0, 2});
    CHECK(front.size() == 4);
    CHECK(back.empty());
    split({1, 0, -2});
    CHECK(front.empty());
    CHECK(back.size() == 4);
    CHECK(clipper.area_error() == 0);  // clear of the window: nothing is in doubt
    split({1, 0, -1});                 // along the side x = 1
    CHECK(front.empty());
    CHECK(back.size() == 4);
    split({1, -1, 0});  // through two corners
    CHECK(area(front) == 2);
    CHECK(area(back) == 2);
    split({1, 1, 2});  // touches a corner
    CHECK(front.size() == 4);
    CHECK(back.empty());
    split({0, 0, 1});  // no line, but a sign
    CHECK(front.size() == 4);
    split({0x1p-1000, 0, 0});  // any scale
    CHECK(area(front) == 2);
  }

  TEST_CASE("an error of the line's constant is in the area") {
    SharpClipper clipper(1);
    SharpPolygon front;
    clipper.set_line(SharpClipper::kWindow, {2, 0, 0, 1e-12});
    clipper.split(clipper.window(), SharpClipper::kWindow, &front, nullptr);
    CHECK(clipper.area_error() >= 2 * 1e-12 / 2);  // the sliver: as long as the window, error / |(a, b)| wide
    CHECK(clipper.area_error() <= 1e-11);
  }
}

}  // namespace moire
