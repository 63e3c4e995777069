// L-infinity discrepancy of edges against an exhaustive search in quadruple precision, random lines and symmetry.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "core/hash.h"
#include "core/parallel.h"
#include "measure/discrepancy/edge_linf.h"
#include "measure/discrepancy/exact_turn.h"
#include "patterns/variants.h"

using namespace moire;
using moire::test::PointSet;
using moire::test::set_of;

namespace {

using Quad = __float128;

double edge_linf_of(const PointSet& set) { return edge_linf({set.x, set.y}); }

// The closed half-plane a X + b Y <= c.
struct HalfPlane {
  Quad a, b, c;
};

// Area of its part of the unit square: clip the square's outline, then the shoelace formula.
Quad area_of(const HalfPlane& h) {
  struct At {
    Quad x, y;
  };
  constexpr int kSquare[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  std::vector<At> part;
  for (std::size_t i = 0; i < 4; ++i) {
    const At from{Quad(kSquare[i][0]), Quad(kSquare[i][1])};
    const At to{Quad(kSquare[(i + 1) % 4][0]), Quad(kSquare[(i + 1) % 4][1])};
    const Quad at_from = h.a * from.x + h.b * from.y - h.c, at_to = h.a * to.x + h.b * to.y - h.c;
    if (at_from <= 0) part.push_back(from);
    if ((at_from < 0 && at_to > 0) || (at_from > 0 && at_to < 0)) {
      const Quad t = at_from / (at_from - at_to);
      part.push_back({from.x + t * (to.x - from.x), from.y + t * (to.y - from.y)});
    }
  }
  Quad twice = 0;
  for (std::size_t i = 0; i < part.size(); ++i) {
    const At p = part[i], q = part[(i + 1) % part.size()];
    twice += p.x * q.y - q.x * p.y;
  }
  return twice / 2;
}

// |share - area|, for the half-plane and for its complement, of points with a x + b y <= c. Relative to point `at`, so
// that the products of coordinates with 52 bits are exact.
Quad excess(const PointSet& set, Quad a, Quad b, Quad at_x, Quad at_y) {
  int below = 0, above = 0;
  for (std::size_t i = 0; i < set.x.size(); ++i) {
    const Quad place = a * (static_cast<Quad>(set.x[i]) - at_x) + b * (static_cast<Quad>(set.y[i]) - at_y);
    below += place <= 0;
    above += place >= 0;
  }
  const Quad area = area_of({a, b, a * at_x + b * at_y}), n = static_cast<Quad>(set.x.size());
  return std::max(below / n - area, above / n - (1 - area));
}

// Every line through two points; through each point those parallel to an axis and the one that it halves.
double by_search(const PointSet& set) {
  Quad best = 0;
  const std::size_t n = set.x.size();
  for (std::size_t i = 0; i < n; ++i) {
    const auto x = static_cast<Quad>(set.x[i]), y = static_cast<Quad>(set.y[i]);
    const auto offer = [&](Quad a, Quad b) { best = std::max(best, excess(set, a, b, x, y)); };
    offer(1, 0);
    offer(0, 1);
    // The chord from (2 h_x, 0) to (0, 2 h_y), seen from each corner whose chord stays inside the square.
    for (const Quad hx : {x, 1 - x})
      for (const Quad hy : {y, 1 - y})
        if (2 * hx <= 1 && 2 * hy <= 1 && (hx > 0 || hy > 0)) offer(hx == x ? hy : -hy, hy == y ? hx : -hx);
    for (std::size_t j = 0; j < n; ++j)
      if (set.x[j] != set.x[i] || set.y[j] != set.y[i])
        offer(y - static_cast<Quad>(set.y[j]), static_cast<Quad>(set.x[j]) - x);
  }
  return static_cast<double>(best);
}

// Both are within half an ulp of D, plus quadruple rounding.
void check_search(const PointSet& set) {
  const double want = by_search(set);
  CHECK(std::fabs(edge_linf_of(set) - want) <= 0x1p-52 * want);
}

// Random points with coordinates k / grid.
PointSet lattice_points(std::size_t n, std::uint32_t grid, std::uint32_t trial, bool inside = false) {
  PointSet set;
  const Key key = pixel_key(draw_hash(12, trial), {0, 0});
  const std::uint32_t first = inside ? 1 : 0;
  for (std::uint32_t i = 0; i < n; ++i) {
    const Words w = hash(key, i, Axis::xy);
    set.x.push_back((first + w.a % (grid - first)) / static_cast<double>(grid));
    set.y.push_back((first + w.b % (grid - first)) / static_cast<double>(grid));
  }
  return set;
}

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("edge L-infinity has the golden values of Zaremba and Hammersley points to 1e-12") {
    struct Golden {
      const char* pattern;
      int n;
      double d;
    };
    // Exact combinatorics in integers, areas in extended precision. The doubles are not quite the ideal points (i /
    // 1600 is rounded), which moves D by 1e-15 or so.
    constexpr Golden kGolden[] = {
        {"zaremba", 16, 17.0 / 96},
        {"zaremba", 256, 0.034505208333333333},
        {"zaremba", 1600, 0.015787760416666667},
        {"hammersley", 16, 0.185546875},
        {"hammersley", 256, 0.03514862060546875},
        {"hammersley", 1600, 0.015625},
    };
    for (const Golden& g : kGolden) {
      CAPTURE(g.pattern);
      CAPTURE(g.n);
      CHECK(std::fabs(edge_linf_of(set_of(g.pattern, g.n)) - g.d) <= 1e-12 * g.d);
    }
  }

  TEST_CASE("edge L-infinity equals an exhaustive search for every pattern") {
    for (const std::string& text : moire::test::variants()) {
      CAPTURE(text);
      check_search(set_of(text, moire::test::usable(moire::test::chosen(text), 9)));
    }
  }

  TEST_CASE("edge L-infinity equals an exhaustive search for random sets up to 12 points") {
    for (int n = 1; n <= 12; ++n)
      for (std::uint32_t trial = 0; trial < 20; ++trial) check_search(set_of("random", n, {6, trial}));
  }

  TEST_CASE("edge L-infinity equals an exhaustive search on lattices, where lines tie and points coincide") {
    for (const std::uint32_t grid : {2u, 3u, 4u, 7u, 8u})
      for (const std::size_t n : {2u, 5u, 9u, 12u})
        for (std::uint32_t trial = 0; trial < 10; ++trial) check_search(lattice_points(n, grid, trial));
  }

  TEST_CASE("edge L-infinity of one point is all but the corner that its chord cuts off") {
    // The closed half-plane with the point and the least area; a point in a corner or on a side has one without area.
    const std::vector<std::pair<double, double>> points = {{0.5, 0.5}, {0.25, 0.75}, {0.9, 0.95}, {0, 0},
                                                           {0, 0.5},   {0.3, 0},     {0.5, 0.1},  {0x1p-1074, 0.5}};
    for (const auto& [x, y] : points) {
      const double hx = std::min(x, 1 - x), hy = std::min(y, 1 - y);
      CHECK(edge_linf_of({{x}, {y}}) == doctest::Approx(1 - 2 * hx * hy).epsilon(1e-15));
      check_search({{x}, {y}});
      // Coincident points are one point.
      CHECK(edge_linf_of({std::vector<double>(40, x), std::vector<double>(40, y)}) == edge_linf_of({{x}, {y}}));
    }
  }

  TEST_CASE("edge L-infinity equals an exhaustive search for collinear, tiny and almost collinear points") {
    check_search({{0.125, 0.25, 0.5, 0.875}, {0.125, 0.25, 0.5, 0.875}});
    check_search({{0.25, 0.25, 0.25}, {0, 0.5, 0.75}});
    check_search({{0, 0, 0, 0.5, 1 - 0x1p-53}, {0, 1.0 / 3, 0.75, 0, 1 - 0x1p-53}});
    check_search({{0, 0.25, 0.5, 0.75}, {0, 0, 0, 0}});
    check_search({{0, 0x1p-900, 0x1p-900, 0.5}, {0, 0x1p-900, 0x1p-899, 0.5}});
    check_search({{0, 0x1p-1074, 0.5, 0x1p-1074}, {0x1p-1074, 0, 0.5, 0x1p-1074}});
    for (int up = -1; up <= 1; ++up)
      for (int right = -1; right <= 1; ++right)
        check_search({{0.1, 0.2 + right * 0x1p-55, 0.4, 0.7, 0.9}, {0.1, 0.2 + up * 0x1p-55, 0.4, 0.7, 0.9}});
  }

  TEST_CASE("edge L-infinity is never below the best of 100,000 random half-planes") {
    for (const char* pattern : {"random", "zaremba", "jittered"}) {
      for (const int n : {1, 4, 16}) {
        const PointSet set = set_of(pattern, n, {4, 2});
        const double d = edge_linf_of(set);
        const Key key = pixel_key(draw_hash(7, static_cast<std::uint32_t>(n)), {0, 0});
        double best = 0;
        for (std::uint32_t i = 0; i < 100'000; ++i) {
          const Words w = hash(key, i, Axis::line);
          const double angle = 6.283185307179586 * unit(w.a, w.b), a = std::cos(angle), b = std::sin(angle);
          // Every other line runs through a point, or almost: random lines alone seldom come near the worst.
          const std::size_t at = w.d % set.x.size();
          const double c = i % 2 == 0 ? a * set.x[at] + b * set.y[at] + 1e-9 : 2.9 * unit(w.c, w.d) - 1.45;
          int inside = 0;
          for (std::size_t j = 0; j < set.x.size(); ++j) inside += a * set.x[j] + b * set.y[j] <= c;
          best = std::max(best, std::fabs(inside / static_cast<double>(n) -
                                          static_cast<double>(area_of({Quad(a), Quad(b), Quad(c)}))));
        }
        CAPTURE(pattern);
        CAPTURE(n);
        CHECK(d >= best - 1e-15);  // rounding of a and b moves a point on the line across it
        CHECK(d <= best + 0.2);    // the search searches
      }
    }
  }

  TEST_CASE("edge L-infinity has the symmetry of the square and the same bits in any order") {
    for (std::uint32_t trial = 0; trial < 6; ++trial) {
      const PointSet set = lattice_points(trial < 3 ? 50 : 200, 256, trial, true);
      const double want = edge_linf_of(set);
      PointSet backwards = set;
      std::reverse(backwards.x.begin(), backwards.x.end());
      std::reverse(backwards.y.begin(), backwards.y.end());
      CHECK(edge_linf_of(backwards) == want);
      for (int symmetry = 1; symmetry < 8; ++symmetry) {
        PointSet moved = set;
        if (symmetry & 1) std::swap(moved.x, moved.y);
        if (symmetry & 2)
          for (double& x : moved.x) x = 1 - x;
        if (symmetry & 4)
          for (double& y : moved.y) y = 1 - y;
        CHECK(std::fabs(edge_linf_of(moved) - want) <= 0x1p-52 * want);  // each is rounded once
      }
    }
  }

  TEST_CASE("edge L-infinity has the same bits for any number of threads") {
    const PointSet set = set_of("jittered", 256);
    const double want = edge_linf_of(set);
    for (const int threads : {1, 2, 5}) {
      const ThreadLimit limit(threads);
      CHECK(edge_linf_of(set) == want);
    }
  }

  TEST_CASE("turns are exact for points on the fixed grid, below it and across") {
    // Three points on a line, one of them moved by the last bit of its coordinates.
    for (const double scale : {1.0, 0x1p-20, 0x1p-300, 0x1p-900}) {
      const double a = 0.125 * scale, b = 0.3 * scale, c = 0.9 * scale;
      for (const double nudge : {-0x1p-54, 0.0, 0x1p-54}) {
        const std::vector<double> x = {a, b, c}, y = {a, b + nudge * scale, c};
        const ExactTurn turn({x, y});
        const int want = (nudge < 0) - (nudge > 0);  // the middle point moved up: a right turn
        CHECK(turn(0, 1, 2) == want);
        CHECK(turn(1, 2, 0) == want);
        CHECK(turn(1, 0, 2) == -want);
        CHECK(turn(0, 0, 1) == 0);
      }
    }
    // One tiny point among ordinary ones.
    const std::vector<double> x = {0, 0x1p-200, 0.5, 0.5}, y = {0, 0x1p-200, 0.5, 0.5 - 0x1p-54};
    const ExactTurn turn({x, y});
    CHECK(turn(0, 1, 2) == 0);
    CHECK(turn(0, 1, 3) == -1);
    CHECK(turn(3, 0, 1) == -1);
    CHECK(turn(3, 1, 0) == 1);
  }
}
