// Star discrepancies against exact values, brute force in 113-bit arithmetic and closed forms.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <string>
#include <vector>

#include "core/hash.h"
#include "measure/discrepancy/star_l2.h"
#include "measure/discrepancy/star_linf.h"
#include "patterns/variants.h"

using namespace moire;
using moire::test::PointSet;
using moire::test::set_of;

namespace {

__extension__ using Quad = __float128;

PointView planar(const PointSet& set) { return {set.x, set.y}; }
PointView spatial(const PointSet& set) { return {set.x, set.y, set.t}; }
PointView view(const PointSet& set, int dims) { return dims == 2 ? planar(set) : spatial(set); }

// Independent points, from a hash of their own; always with a t.
PointSet random_set(std::size_t n, std::uint32_t trial) {
  const Key key = pixel_key(draw_hash(11, trial), {});
  PointSet set = test::room_for(n, true);
  for (std::size_t i = 0; i < n; ++i) {
    const auto index = static_cast<std::uint32_t>(i);
    const Words a = hash(key, index, Axis::set, 0), b = hash(key, index, Axis::set, 1);
    set.x[i] = unit(a.a, a.b);
    set.y[i] = unit(a.c, a.d);
    set.t[i] = unit(b.a, b.b);
  }
  return set;
}

// Small sets with all that is special: ends of the interval, points that coincide, share coordinates or lie in a line.
std::vector<PointSet> special_sets() {
  const double last = 1 - 0x1p-53, tiny = 0x1p-1074;
  std::vector<PointSet> sets{
      {{0}, {0}, {0}},
      {{last}, {last}, {last}},
      {{0.25}, {0.75}, {0.5}},
      {{0.3, 0.3, 0.3}, {0.7, 0.7, 0.7}, {0.1, 0.1, 0.1}},
      {{0, 0, 0, 0}, {0, 0.2, 0.4, 0.6}, {0.1, 0.1, 0.9, 0}},
      {{0, 0.2, 0.4, 0.6}, {0, 0, 0, 0}, {0, 0, 0, 0}},
      {{0.1, 0.2, 0.3, 0.4, 0.5}, {0.1, 0.2, 0.3, 0.4, 0.5}, {0.1, 0.2, 0.3, 0.4, 0.5}},
      {{0.1, 0.2, 0.3, 0.4, 0.5}, {0.5, 0.4, 0.3, 0.2, 0.1}, {0.1, 0.2, 0.3, 0.2, 0.1}},
      {{0.5, 0.5, 0.25, 0.25}, {0.5, 0.25, 0.5, 0.25}, {0.5, 0.5, 0.5, 0.5}},
      {{tiny, last, 0.5, 0.5}, {last, tiny, 0.5, 0.5}, {0.5, 0.5, tiny, last}},
  };
  for (std::uint32_t trial = 0; trial < 60; ++trial) {
    PointSet set = random_set(1 + trial % 12, trial);
    sets.push_back(set);
    // The same on a coarse lattice: many ties.
    for (std::vector<double>* v : {&set.x, &set.y, &set.t})
      for (double& c : *v) c = std::floor(4 * c) / 4;
    sets.push_back(set);
  }
  return sets;
}

// Warnock's formula as it stands.
Quad warnock(const PointSet& set, int dims) {
  const std::size_t n = set.x.size();
  const std::array<const std::vector<double>*, 3> axes{&set.x, &set.y, &set.t};
  Quad linear = 0, squares = 0;
  for (std::size_t i = 0; i < n; ++i) {
    Quad product = 1;
    for (int d = 0; d < dims; ++d) {
      const auto x = static_cast<Quad>((*axes[static_cast<std::size_t>(d)])[i]);
      product *= 1 - x * x;
    }
    linear += product;
    for (std::size_t j = 0; j < n; ++j) {
      Quad box = 1;
      for (int d = 0; d < dims; ++d) {
        const auto& v = *axes[static_cast<std::size_t>(d)];
        box *= 1 - static_cast<Quad>(std::max(v[i], v[j]));
      }
      squares += box;
    }
  }
  const Quad count = static_cast<Quad>(n), constant = Quad{1} / (dims == 2 ? 9 : 27),
             half = Quad{1} / (dims == 2 ? 2 : 4);
  return constant - half * linear / count + squares / (count * count);
}

// The definition: D is (count in a grid cell's boxes) - x y (t) and its square is integrated cell by cell between
// neighbouring coordinates, where the count is constant. No closed form of Warnock's in it.
Quad defined_square(const PointSet& set, int dims) {
  const std::size_t n = set.x.size();
  const auto knots = [](std::vector<double> v) {
    v.push_back(0);
    v.push_back(1);
    std::sort(v.begin(), v.end());
    return v;
  };
  const std::vector<double> xs = knots(set.x), ys = knots(set.y);
  const std::vector<double> ts = dims == 3 ? knots(set.t) : std::vector<double>{0, 1};
  const auto power = [](double lo, double hi, int p) {  // integral of x^p
    const auto a = static_cast<Quad>(lo), b = static_cast<Quad>(hi);
    return p == 0 ? b - a : p == 1 ? (b * b - a * a) / 2 : (b * b * b - a * a * a) / 3;
  };
  Quad sum = 0;
  for (std::size_t i = 0; i + 1 < xs.size(); ++i)
    for (std::size_t j = 0; j + 1 < ys.size(); ++j)
      for (std::size_t k = 0; k + 1 < ts.size(); ++k) {
        int inside = 0;
        for (std::size_t p = 0; p < n; ++p)
          inside += set.x[p] <= xs[i] && set.y[p] <= ys[j] && (dims == 2 || set.t[p] <= ts[k]) ? 1 : 0;
        const Quad share = static_cast<Quad>(inside) / static_cast<Quad>(n);
        const auto volume = [&](int p) {
          return power(xs[i], xs[i + 1], p) * power(ys[j], ys[j + 1], p) * power(ts[k], ts[k + 1], dims == 3 ? p : 0);
        };
        sum += share * share * volume(0) - 2 * share * volume(1) + volume(2);
      }
  return sum;
}

// The same sums as warnock() in 2-D by a tree over the ranks of y (P. M. Fenwick, 1994), for many points.
Quad warnock_by_tree(const PointSet& set) {
  const std::size_t n = set.x.size();
  const auto sorted = [n](const std::vector<double>& v) {
    std::vector<std::size_t> order(n);
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return v[a] < v[b]; });
    return order;
  };
  const std::vector<std::size_t> by_x = sorted(set.x), by_y = sorted(set.y);
  std::vector<std::size_t> rank(n);
  for (std::size_t i = 0; i < n; ++i) rank[by_y[i]] = i;
  struct Node {
    Quad count = 0, rest = 0;
  };
  std::vector<Node> tree(n + 1);
  Quad all = 0, linear = 0, squares = 0;
  for (const std::size_t i : by_x) {
    const auto x = static_cast<Quad>(set.x[i]), y = static_cast<Quad>(set.y[i]);
    Node below;
    for (std::size_t k = rank[i]; k > 0; k -= k & (~k + 1)) {
      below.count += tree[k].count;
      below.rest += tree[k].rest;
    }
    squares += (1 - x) * ((1 - y) * (1 + 2 * below.count) + 2 * (all - below.rest));
    linear += (1 - x * x) * (1 - y * y);
    all += 1 - y;
    for (std::size_t k = rank[i] + 1; k <= n; k += k & (~k + 1)) {
      tree[k].count += 1;
      tree[k].rest += 1 - y;
    }
  }
  const Quad count = static_cast<Quad>(n);
  return Quad{1} / 9 - linear / (2 * count) + squares / (count * count);
}

double relative_error(double got, Quad want) {
  return std::fabs(static_cast<double>((static_cast<Quad>(got) - want) / want));
}

// Rounded correctly, or to the neighbour where 106 bits could not tell which.
constexpr double kOneRounding = 0x1p-53 * (1 + 1e-6);

// Closed and open boxes that end in coordinates of points or in 1.
double star_by_boxes(const PointSet& set) {
  const std::size_t n = set.x.size();
  std::vector<double> xs = set.x, ys = set.y;
  xs.push_back(1);
  ys.push_back(1);
  Quad most = 0;
  for (const double x : xs)
    for (const double y : ys) {
      int closed = 0, open = 0;
      for (std::size_t p = 0; p < n; ++p) {
        closed += set.x[p] <= x && set.y[p] <= y ? 1 : 0;
        open += set.x[p] < x && set.y[p] < y ? 1 : 0;
      }
      const Quad area = static_cast<Quad>(x) * static_cast<Quad>(y), count = static_cast<Quad>(n);
      most = std::max({most, closed / count - area, area - open / count});
    }
  return static_cast<double>(most);
}

// star_linf.h's bound.
constexpr double kLinfError = 0x1p-51;

struct Golden {
  int n;
  double planar, spatial, linf;  // T^2, T^2 and D
};
// Exact rational arithmetic on exact rational points.
constexpr Golden kZaremba[] = {{16, 6059.0 / 4718592, 2394405889.0 / 1550227341312, 0.125},
                               {256, 6.5057376761817269855e-6, 0.000014110730648786592115, 0.010986328125},
                               {1600, 1.9147035862422651715e-7, 5.7859898479429273181e-7, 0.002049967447916667}};
constexpr Golden kHammersley[] = {{16, 22655.0 / 4718592, 777941.0 / 127401984, 0.171875},
                                  {256, 0.00003940363401650554604, 0.000045946174230843660511, 0.01605224609375},
                                  {1600, 1.4784166329643792576e-6, 1.8192392798510511972e-6, 0.003194580078125}};

PointSet shuffled(const PointSet& set, std::uint32_t trial) {
  const Key key = pixel_key(draw_hash(12, trial), {});
  std::vector<std::size_t> order(set.x.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return hash(key, static_cast<std::uint32_t>(a), Axis::order).a <
           hash(key, static_cast<std::uint32_t>(b), Axis::order).a;
  });
  PointSet out;
  for (const std::size_t i : order) {
    out.x.push_back(set.x[i]);
    out.y.push_back(set.y[i]);
    if (!set.t.empty()) out.t.push_back(set.t[i]);
  }
  return out;
}

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("star discrepancies of Zaremba and Hammersley points are the exact ones") {
    // 1e-12 relative: the points are stored with errors up to 2^-54, which moves T^2 by less than 2 k 2^-54 D_N, at
    // most 4e-12 of it, in fact a hundredth of that.
    const auto check = [](const char* name, const Golden& g) {
      CAPTURE(name);
      CAPTURE(g.n);
      const PointSet set = set_of(name, g.n);
      CHECK(std::fabs(star_l2_squared(planar(set)) / g.planar - 1) < 1e-12);
      CHECK(std::fabs(star_l2_squared(spatial(set)) / g.spatial - 1) < 1e-12);
      CHECK(std::fabs(star_linf(planar(set)) / g.linf - 1) < 1e-12);
      CHECK(star_linf(spatial(set)) == star_linf(planar(set)));
    };
    for (const Golden& g : kZaremba) check("zaremba", g);
    for (const Golden& g : kHammersley) check("hammersley", g);
  }

  TEST_CASE("the squared star discrepancy of small sets is the integral that defines it, correctly rounded") {
    for (const PointSet& set : special_sets())
      for (const int dims : {2, 3}) {
        CAPTURE(set.x.size());
        const double got = star_l2_squared(view(set, dims));
        const Quad defined = defined_square(set, dims), formula = warnock(set, dims);
        // Sums of at most 2,200 numbers below 1 with 113 bits.
        CHECK(std::fabs(static_cast<double>(defined - formula)) < 2200 * 0x1p-111);
        CHECK(relative_error(got, formula) < kOneRounding);
        CHECK(got > 0);
      }
  }

  TEST_CASE("Warnock's sums by halving are those over all pairs, whatever the size") {
    for (const std::size_t n : {2u, 3u, 4u, 5u, 7u, 8u, 31u, 32u, 33u, 100u, 255u, 256u, 257u, 700u}) {
      const PointSet set = random_set(n, 100);
      for (const int dims : {2, 3}) {
        CAPTURE(n);
        CHECK(relative_error(star_l2_squared(view(set, dims)), warnock(set, dims)) < kOneRounding);
      }
    }
    // Few values of each coordinate and many points: nearly all is ties.
    PointSet lattice = random_set(500, 101);
    for (std::vector<double>* v : {&lattice.x, &lattice.y, &lattice.t})
      for (double& c : *v) c = std::floor(8 * c) / 8;
    for (const int dims : {2, 3})
      CHECK(relative_error(star_l2_squared(view(lattice, dims)), warnock(lattice, dims)) < kOneRounding);
  }

  TEST_CASE("cancellation costs the star discrepancy of 100,000 Zaremba points no digit") {
    for (const int n : {1600, 16384, 100000}) {
      const PointSet set = set_of("zaremba", n);
      CAPTURE(n);
      CHECK(relative_error(star_l2_squared(planar(set)), warnock_by_tree(set)) < kOneRounding);
    }
    const PointSet set = set_of("zaremba", 1600);
    CHECK(relative_error(star_l2_squared(spatial(set)), warnock(set, 3)) < kOneRounding);
  }

  TEST_CASE("the order of the points changes no bit of a star discrepancy") {
    for (const PointSet& set : special_sets()) {
      const PointSet other = shuffled(set, static_cast<std::uint32_t>(set.x.size()));
      for (const int dims : {2, 3}) CHECK(star_l2_squared(view(set, dims)) == star_l2_squared(view(other, dims)));
      CHECK(star_linf(planar(set)) == star_linf(planar(other)));
    }
    for (const std::string& text : test::variants()) {
      CAPTURE(text);
      const PointSet set = set_of(text, test::usable(test::chosen(text), 100)), other = shuffled(set, 3);
      for (const int dims : set.t.empty() ? std::vector{2} : std::vector{2, 3})
        CHECK(star_l2_squared(view(set, dims)) == star_l2_squared(view(other, dims)));
      CHECK(star_linf(planar(set)) == star_linf(planar(other)));
    }
  }

  TEST_CASE("the axes of a star discrepancy may be exchanged") {
    for (const PointSet& set : special_sets()) {
      const PointSet swapped{set.y, set.x, set.t}, turned{set.t, set.x, set.y};
      // Both are correctly rounded but for ties that 106 bits cannot tell.
      CHECK(std::fabs(star_l2_squared(planar(set)) / star_l2_squared(planar(swapped)) - 1) <= 0x1p-52);
      CHECK(std::fabs(star_l2_squared(spatial(set)) / star_l2_squared(spatial(turned)) - 1) <= 0x1p-52);
      CHECK(std::fabs(star_linf(planar(set)) - star_linf(planar(swapped))) <= 2 * kLinfError);
    }
  }

  TEST_CASE("a single point has the closed forms of one point") {
    for (std::uint32_t trial = 0; trial < 50; ++trial) {
      const PointSet set = random_set(1, trial);
      const double x = set.x[0], y = set.y[0], t = set.t[0];
      // The box that ends in the point, closed; and the two empty ones beside it, open.
      CHECK(std::fabs(star_linf(planar(set)) - std::max({1 - x * y, x, y})) < kLinfError);
      const double planar_square = 1.0 / 9 - (1 - x * x) * (1 - y * y) / 2 + (1 - x) * (1 - y);
      CHECK(std::fabs(star_l2_squared(planar(set)) - planar_square) < 8 * 0x1p-53);  // that many roundings
      const double spatial_square =
          1.0 / 27 - (1 - x * x) * (1 - y * y) * (1 - t * t) / 4 + (1 - x) * (1 - y) * (1 - t);
      CHECK(std::fabs(star_l2_squared(spatial(set)) - spatial_square) < 12 * 0x1p-53);
    }
  }

  TEST_CASE("a set given several times over has the star discrepancies of the set") {
    for (const PointSet& set : special_sets()) {
      PointSet many = set;
      for (int copy = 1; copy < 4; ++copy) {
        many.x.insert(many.x.end(), set.x.begin(), set.x.end());
        many.y.insert(many.y.end(), set.y.begin(), set.y.end());
        many.t.insert(many.t.end(), set.t.begin(), set.t.end());
      }
      for (const int dims : {2, 3})
        CHECK(std::fabs(star_l2_squared(view(set, dims)) / star_l2_squared(view(many, dims)) - 1) <= 0x1p-52);
      CHECK(std::fabs(star_linf(planar(set)) - star_linf(planar(many))) < 2 * kLinfError);
    }
  }

  TEST_CASE("the largest star discrepancy is the one of brute force over all boxes") {
    for (const PointSet& set : special_sets()) {
      CAPTURE(set.x.size());
      CHECK(std::fabs(star_linf(planar(set)) - star_by_boxes(set)) < kLinfError);
    }
    for (const std::size_t n : {13u, 31u, 32u, 33u, 60u}) {
      PointSet set = random_set(n, 200);
      CHECK(std::fabs(star_linf(planar(set)) - star_by_boxes(set)) < kLinfError);
      for (double& c : set.x) c = std::floor(6 * c) / 6;
      for (double& c : set.y) c = std::floor(5 * c) / 5;
      CHECK(std::fabs(star_linf(planar(set)) - star_by_boxes(set)) < kLinfError);
    }
  }

  TEST_CASE("no pattern's star discrepancy in the mean square exceeds the largest one") {
    for (const std::string& text : test::variants()) {
      CAPTURE(text);
      for (const int asked : {1, 16, 100}) {
        const PointSet set = set_of(text, test::usable(test::chosen(text), asked));
        const double mean_square = star_l2_squared(planar(set)), largest = star_linf(planar(set));
        CHECK(mean_square > 0);
        CHECK(mean_square <= largest * largest);
        CHECK(largest <= 1);
        CHECK(std::fabs(largest - star_by_boxes(set)) < kLinfError);
      }
    }
  }
}
