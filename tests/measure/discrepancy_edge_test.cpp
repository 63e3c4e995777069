// L2 discrepancy of edges against integration line by line, quadruple precision, closed forms and symmetry.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "core/hash.h"
#include "core/parallel.h"
#include "gauss.h"
#include "measure/discrepancy/edge_l2.h"
#include "measure/discrepancy/edge_pairs.h"
#include "patterns/variants.h"

using namespace moire;
using moire::test::PointSet;
using moire::test::set_of;

namespace {

constexpr std::array kLaws = {LineLaw::isotropic, LineLaw::printed};
constexpr double kPromised = 1e-15;  // absolute error of T^2 that the header promises
constexpr double kMeanDistance = 0.52140543316472067833, kMeanSeparation = 0.25856738518752638724;

double edge_l2(const PointSet& set, LineLaw law) { return edge_l2_squared({set.x, set.y}, law); }

struct At {
  double x, y;
};

// Area of the part of the unit square where c X + s Y <= p: clip the square's outline, then the shoelace formula.
double area_below(double c, double s, double p) {
  constexpr std::array<At, 4> kSquare = {{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
  std::vector<At> part;
  for (std::size_t i = 0; i < 4; ++i) {
    const At a = kSquare[i], b = kSquare[(i + 1) % 4];
    const double at_a = c * a.x + s * a.y - p, at_b = c * b.x + s * b.y - p;
    if (at_a <= 0) part.push_back(a);
    if ((at_a < 0) != (at_b < 0) && at_a != at_b) {
      const double t = at_a / (at_a - at_b);
      part.push_back({a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)});
    }
  }
  double twice = 0;
  for (std::size_t i = 0; i < part.size(); ++i) {
    const At a = part[i], b = part[(i + 1) % part.size()];
    twice += a.x * b.y - b.x * a.y;
  }
  return twice / 2;
}

// Integral over p of (share of points with c x + s y <= p, less the area there)^2. Between projections of points and of
// corners the integrand is a polynomial of degree 4, for which three nodes are exact.
double integral_over_places(const PointSet& set, double c, double s) {
  std::vector<double> shares, breaks = {0, c, s, c + s};
  for (std::size_t i = 0; i < set.x.size(); ++i) shares.push_back(c * set.x[i] + s * set.y[i]);
  breaks.insert(breaks.end(), shares.begin(), shares.end());
  std::sort(breaks.begin(), breaks.end());
  std::sort(shares.begin(), shares.end());
  static const auto rule = test::gauss(3);
  double sum = 0;
  for (std::size_t b = 0; b + 1 < breaks.size(); ++b) {
    const double length = breaks[b + 1] - breaks[b];
    for (const auto& [node, weight] : rule) {
      const double p = breaks[b] + node * length;
      const auto below = std::upper_bound(shares.begin(), shares.end(), p) - shares.begin();
      const double difference = static_cast<double>(below) / static_cast<double>(set.x.size()) - area_below(c, s, p);
      sum += length * weight * difference * difference;
    }
  }
  return sum;
}

// T^2 by its definition for both laws. Directions are cut where two points or corners project to one place and at
// multiples of pi/4; between, the integrand is smooth, but it has poles where lines are parallel to an axis, from which
// the pieces stay as far away as they are long, at the least. Isotropic lines have the density dp dtheta / 4; the
// printed ones have angles with density 1 / (4 max^2) of (|cos|, |sin|) and uniform places on the square's width |cos|
// + |sin|.
std::array<double, 2> by_definition(const PointSet& set) {
  std::vector<At> marks = {{0, 0}, {1, 0}, {0, 1}, {1, 1}};
  for (std::size_t i = 0; i < set.x.size(); ++i) marks.push_back({set.x[i], set.y[i]});
  std::vector<double> breaks;
  for (int k = 0; k <= 4; ++k) breaks.push_back(k * std::numbers::pi / 4);
  for (int k = 1; k <= 20; ++k)
    for (const double pole : {0.0, 0.5, 1.0})
      for (const double side : {-1.0, 1.0}) {
        const double turns = pole + side * std::ldexp(0.25, -k);
        if (turns > 0 && turns < 1) breaks.push_back(turns * std::numbers::pi);
      }
  for (std::size_t i = 0; i < marks.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const double angle = std::atan2(marks[j].x - marks[i].x, marks[i].y - marks[j].y);
      breaks.push_back(angle < 0 ? angle + std::numbers::pi : angle);
    }
  }
  std::sort(breaks.begin(), breaks.end());
  static const auto rule = test::gauss(20);
  std::array<double, 2> sums{};
  for (std::size_t b = 0; b + 1 < breaks.size(); ++b) {
    const double length = breaks[b + 1] - breaks[b];
    if (length < 1e-14) continue;
    for (const auto& [node, weight] : rule) {
      const double angle = breaks[b] + node * length, c = std::cos(angle), s = std::sin(angle);
      // Mirrored in x where cos < 0, so that the square projects to [0, c + s].
      PointSet seen = set;
      if (c < 0)
        for (double& x : seen.x) x = 1 - x;
      const double a = std::fabs(c), inner = length * weight * integral_over_places(seen, a, s);
      const double larger = std::max(a, s);
      sums[0] += inner / 4;
      sums[1] += inner / (4 * larger * larger * (a + s));
    }
  }
  return sums;
}

void check_definition(const PointSet& set) {
  const std::array<double, 2> want = by_definition(set);
  // T^2 is at most 0.2; the rounding of the quadrature, the promise of 1e-15 and a margin. Measured: 7e-16.
  for (std::size_t law = 0; law < 2; ++law) CHECK(std::fabs(edge_l2(set, kLaws[law]) - want[law]) < 3e-15);
}

using Quad = __float128;

Quad quad_root(Quad v) {
  if (v == 0) return 0;
  Quad root = static_cast<Quad>(std::sqrt(static_cast<double>(v)));
  for (int step = 0; step < 2; ++step) root += (v / root - root) / 2;  // doubles the digits twice
  return root;
}

// 2 atanh(s), |s| <= 1/3: 38 terms reach 9^-38 < 1e-36.
Quad twice_atanh(Quad s) {
  Quad sum = 0;
  for (int k = 37; k >= 0; --k) sum = sum * s * s + Quad(2) / (2 * k + 1);
  return sum * s;
}

Quad quad_log(Quad v) {
  int halvings = 0;
  for (; v > 2; v /= 2) ++halvings;
  return twice_atanh((v - 1) / (v + 1)) + halvings * twice_atanh(Quad(1) / 3);  // ln 2 = 2 atanh(1/3)
}

Quad quad_distance(Quad dx, Quad dy) { return quad_root(dx * dx + dy * dy); }

Quad quad_separation(Quad dx, Quad dy) {
  const Quad a = dx < 0 ? -dx : dx, b = dy < 0 ? -dy : dy, u = a > b ? a : b, v = a > b ? b : a;
  if (u == 0) return 0;
  return (u - v + (u + v) * twice_atanh(v / (2 * u + v))) / 2;  // ln(1 + v/u) = 2 atanh(v / (2u + v))
}

// Integrals of the two over [0, a] x [0, b], as DISTANCE and as H of the two halves where |dx| > |dy| and the reverse.
Quad quad_distance_to_corner(Quad a, Quad b) {
  if (a == 0 || b == 0) return 0;
  const Quad r = quad_root(a * a + b * b);
  return a * b * r / 3 + (a * a * a * quad_log((b + r) / a) + b * b * b * quad_log((a + r) / b)) / 6;
}

Quad quad_h(Quad a, Quad b) {  // integral of h(a, v) over v from 0 to b
  if (a == 0) return b * b / 4;
  if (b == 0) return 0;
  const Quad sum = (a + b) * (a + b) / 2;
  if (b <= a) return (a * b / 2 - 3 * b * b / 4 + sum * quad_log(1 + b / a)) / 2;
  const Quad two_logs = 2 * a * a * quad_log(2);
  return (two_logs - a * a / 4) / 2 + ((b - a) * (b - a) / 2 + sum * quad_log(1 + a / b) - two_logs + a * (b - a) / 2 +
                                       a * a / 2 * quad_log(b / a)) /
                                          2;
}

Quad quad_separation_from_corner(Quad a, Quad b) { return (a * quad_h(a, b) + b * quad_h(b, a)) / 3; }

double in_quad(const PointSet& set, LineLaw law) {
  const bool isotropic = law == LineLaw::isotropic;
  const auto pair = isotropic ? quad_distance : quad_separation;
  const auto corner = isotropic ? quad_distance_to_corner : quad_separation_from_corner;
  Quad pairs = 0, square = 0;
  const std::size_t n = set.x.size();
  for (std::size_t i = 0; i < n; ++i) {
    const auto x = static_cast<Quad>(set.x[i]), y = static_cast<Quad>(set.y[i]);
    square += corner(x, y) + corner(1 - x, y) + corner(x, 1 - y) + corner(1 - x, 1 - y);
    for (std::size_t j = 0; j < i; ++j)
      pairs += 2 * pair(x - static_cast<Quad>(set.x[j]), y - static_cast<Quad>(set.y[j]));
  }
  const Quad mean = isotropic ? (2 + quad_root(2) + 5 * quad_log(1 + quad_root(2))) / 15 : (24 * quad_log(2) - 5) / 45;
  const Quad count = static_cast<Quad>(n);
  return static_cast<double>((2 * square / count - pairs / count / count - mean) / (isotropic ? 4 : 2));
}

// Points with coordinates k / 64, 0 < k < 64: 1 - x is exact and stays inside.
PointSet coarse_points(std::size_t n, std::uint32_t trial) {
  PointSet set;
  const Key key = pixel_key(draw_hash(11, trial), {0, 0});
  for (std::uint32_t i = 0; i < n; ++i) {
    const Words w = hash(key, i, Axis::xy);
    set.x.push_back((1 + w.a % 63) / 64.0);
    set.y.push_back((1 + w.b % 63) / 64.0);
  }
  return set;
}

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("edge L2 has the golden values of Zaremba and Hammersley points to 1e-15") {
    struct Golden {
      const char* pattern;
      int n;
      double isotropic, printed;
    };
    // Computed with 113 bits from coordinates of 113 bits, those of N = 16 once more with 40 digits.
    constexpr Golden kGolden[] = {
        {"zaremba", 16, 1.54294142636332777848e-03, 1.54813237398581970309e-03},
        {"zaremba", 256, 1.85444045384297744557e-05, 1.89673878617401495930e-05},
        {"zaremba", 1600, 1.10122796810216342991e-06, 1.10545818282262451056e-06},
        {"hammersley", 16, 2.33675729936556633769e-03, 2.36739772048468850305e-03},
        {"hammersley", 256, 2.80970511323066687811e-05, 2.90789824870951785707e-05},
        {"hammersley", 1600, 1.50035905939179974288e-06, 1.51276808149481206964e-06},
    };
    for (const Golden& g : kGolden) {
      CAPTURE(g.pattern);
      CAPTURE(g.n);
      const PointSet set = set_of(g.pattern, g.n);
      CHECK(std::fabs(edge_l2(set, LineLaw::isotropic) - g.isotropic) <= kPromised);
      CHECK(std::fabs(edge_l2(set, LineLaw::printed) - g.printed) <= kPromised);
    }
  }

  TEST_CASE("edge L2 is the mean over lines, integrated direction by direction, for every pattern") {
    for (const std::string& text : moire::test::variants()) {
      CAPTURE(text);
      check_definition(set_of(text, moire::test::usable(moire::test::chosen(text), 4)));
    }
    for (const int n : {2, 3, 7, 12}) check_definition(set_of("random", n, {3, static_cast<std::uint32_t>(n)}));
  }

  TEST_CASE("edge L2 is the mean over lines for one, coincident and collinear points and points on the border") {
    check_definition({{0.3}, {0.8}});
    check_definition({{0}, {0}});
    check_definition({{0}, {0.5}});
    check_definition({{0.25, 0.25, 0.25, 0.75}, {0.5, 0.5, 0.5, 0.125}});
    check_definition({{0.125, 0.25, 0.5, 0.875}, {0.125, 0.25, 0.5, 0.875}});
    check_definition({{0.25, 0.25, 0.25}, {0, 0.5, 0.75}});
    check_definition({{0, 0, 0, 0.5, 1 - 0x1p-53}, {0, 1.0 / 3, 0.75, 0, 1 - 0x1p-53}});
    check_definition({{0.125, 0.375, 0.625, 0.875, 0.125, 0.375}, {0.25, 0.25, 0.25, 0.25, 0.75, 0.75}});
    check_definition({{0x1p-1074, 0x1p-600, 0.5}, {0, 0x1p-600, 0x1p-1074}});
  }

  TEST_CASE("edge L2 of one point in a corner is the closed form") {
    const double distance = (std::numbers::sqrt2 + std::asinh(1.0)) / 3;  // mean distance to a corner
    const double separation = (16 * std::numbers::ln2 - 2) / 24;          // mean of h to a corner
    const PointSet corner{{0}, {0}}, many{std::vector<double>(300, 0.0), std::vector<double>(300, 0.0)};
    for (const PointSet& set : {corner, many}) {  // coincident points are one
      CHECK(std::fabs(edge_l2(set, LineLaw::isotropic) - (2 * distance - kMeanDistance) / 4) <= kPromised);
      CHECK(std::fabs(edge_l2(set, LineLaw::printed) - (2 * separation - kMeanSeparation) / 2) <= kPromised);
    }
  }

  TEST_CASE("edge L2 keeps its promise of 1e-15 against 113 bits") {
    // Sizes around the blocks of 128 and the 8 lanes.
    double worst = 0;
    const auto check = [&](const PointSet& set, LineLaw law) {
      const double error = std::fabs(edge_l2(set, law) - in_quad(set, law));
      CHECK(error <= kPromised);
      worst = std::max(worst, error);
    };
    for (const int n : {1, 2, 7, 8, 9, 127, 128, 129, 300})
      for (const LineLaw law : kLaws) check(set_of("random", n, {8, static_cast<std::uint32_t>(n)}), law);
    for (const char* pattern : {"zaremba", "jittered", "regular"})
      for (const LineLaw law : kLaws) check(set_of(pattern, 256), law);
    check(set_of("zaremba", 1600), LineLaw::isotropic);
    MESSAGE("worst error of T^2: ", worst);
  }

  TEST_CASE("edge L2 has the symmetry of the square and forgets the order of points") {
    for (const std::uint32_t trial : {0u, 1u, 2u}) {
      const PointSet set = coarse_points(200, trial);
      for (const LineLaw law : kLaws) {
        const double want = edge_l2(set, law);
        for (int symmetry = 1; symmetry < 8; ++symmetry) {
          PointSet moved = set;
          if (symmetry & 1) std::swap(moved.x, moved.y);
          if (symmetry & 2)
            for (double& x : moved.x) x = 1 - x;
          if (symmetry & 4)
            for (double& y : moved.y) y = 1 - y;
          CHECK(std::fabs(edge_l2(moved, law) - want) <= kPromised);
        }
        PointSet backwards = set;
        std::reverse(backwards.x.begin(), backwards.x.end());
        std::reverse(backwards.y.begin(), backwards.y.end());
        CHECK(std::fabs(edge_l2(backwards, law) - want) <= kPromised);
      }
    }
  }

  TEST_CASE("sums over pairs have the same bits for every set of instructions and any number of threads") {
    for (const int n : {1, 2, 7, 8, 9, 127, 128, 129, 136, 1500}) {
      const PointSet set = set_of("random", n);
      const PointView view{set.x, set.y};
      for (const LineLaw law : kLaws) {
        const Dd want = sum_over_pairs(view, edge_pair_tiles(law).front());
        for (const PairTile tile : edge_pair_tiles(law)) {
          for (const int threads : {1, 2, 5}) {
            const ThreadLimit limit(threads);
            const Dd got = sum_over_pairs(view, tile);
            CHECK(got.hi == want.hi);
            CHECK(got.lo == want.lo);
          }
        }
      }
    }
  }

  TEST_CASE("edge L2 of random and jittered points has the expected mean within 3 standard errors") {
    for (const LineLaw law : kLaws) {
      const double constant = law == LineLaw::isotropic ? kMeanDistance / 4 : kMeanSeparation / 2;
      for (const int n : {4, 16, 64}) {
        for (const char* pattern : {"random", "jittered"}) {
          constexpr int kTrials = 1000;
          double sum = 0, squares = 0;
          for (std::uint32_t t = 0; t < kTrials; ++t) {
            const double value = edge_l2(set_of(pattern, n, {21, t}), law);
            sum += value;
            squares += value * value;
          }
          const double mean = sum / kTrials, error = std::sqrt((squares / kTrials - mean * mean) / (kTrials - 1));
          const double want = constant / (pattern[0] == 'r' ? n : n * std::sqrt(n));
          CAPTURE(pattern);
          CAPTURE(n);
          CHECK(std::fabs(mean - want) < 3 * error);
        }
      }
    }
  }
}
